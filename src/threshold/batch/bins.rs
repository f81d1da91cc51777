//! Thresholds counted in equal bins, as they come out of a batch.

use super::evaluator::Lane;
use super::isa::Isa;

/// Counts of thresholds in equal bins over [0, 1].
///
/// Bin `i` of `k` holds `[i/k, (i+1)/k)`; the last one also holds 1. What is not in [0, 1], NaN included, belongs to no
/// bin.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bins {
    /// One count a bin, and one for what belongs to none.
    counts: Vec<u64>,
}

impl Bins {
    /// The largest number of bins: indices are computed in `f32`.
    pub const MOST: usize = 1 << 22;

    /// Makes `bins` empty bins.
    ///
    /// # Panics
    /// If `bins` is not a power of two up to [`Bins::MOST`]; only then is the bin of an `f32` exact.
    #[must_use]
    pub fn new(bins: usize) -> Self {
        assert!(bins.is_power_of_two() && bins <= Self::MOST, "a power of two up to 2^22, not {bins}");
        Self { counts: vec![0; bins + 1] }
    }

    /// Counts values.
    pub fn add<R: Lane>(&mut self, isa: Isa, values: &[R]) {
        R::count(isa, values, &mut self.counts);
    }

    /// Adds the counts of other bins.
    ///
    /// # Panics
    /// If their number is another.
    pub fn merge(&mut self, other: &Self) {
        assert_eq!(self.counts.len(), other.counts.len(), "bins to merge must be equally many");
        for (mine, theirs) in self.counts.iter_mut().zip(&other.counts) {
            *mine += theirs;
        }
    }

    /// Returns the count of every bin, the lowest first.
    #[must_use]
    pub fn counts(&self) -> &[u64] {
        &self.counts[..self.counts.len() - 1]
    }

    /// Returns how many values belong to no bin.
    #[must_use]
    pub fn outside(&self) -> u64 {
        self.counts[self.counts.len() - 1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_is_counted_once_and_where_it_belongs() {
        let below = |x: f32| f32::from_bits(x.to_bits() - 1);
        let values =
            [0.0, -0.0, below(0.25), 0.25, 0.5, below(1.0), 1.0, f32::NAN, -1e-9, 1.5, f32::INFINITY];
        for isa in Isa::available() {
            let mut bins = Bins::new(4);
            for _ in 0..100 {
                bins.add(isa, &values);
            }
            assert_eq!(bins.counts(), [300, 100, 100, 200], "{isa}");
            assert_eq!(bins.outside(), 400);
            let doubled = values.map(f64::from);
            let mut wide = Bins::new(4);
            wide.add(isa, &doubled.repeat(100));
            assert_eq!(bins, wide);
            bins.merge(&wide);
            assert_eq!(bins.counts(), [600, 200, 200, 400]);
        }
    }

    #[test]
    #[should_panic(expected = "a power of two")]
    fn ten_bins_are_refused() {
        let _ = Bins::new(10);
    }
}
