//! Counts of how often each equal part of the unit interval came up.

/// Counts values in equal bins over `[0, 1]`.
///
/// Bin `i` of `k` holds `[i/k, (i+1)/k)`; the last one also holds 1. What is not in `[0, 1]`, NaN included,
/// is counted apart and belongs to no bin.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Histogram {
    counts: Vec<u64>,
    /// How many values were NaN or not in `[0, 1]`.
    pub outside: u64,
}

impl Histogram {
    /// Makes an empty histogram.
    ///
    /// # Panics
    /// If `bins` is 0.
    #[must_use]
    pub fn new(bins: usize) -> Self {
        assert!(bins > 0, "a histogram needs a bin");
        Self { counts: vec![0; bins], outside: 0 }
    }

    /// Counts one value.
    pub fn add(&mut self, x: f64) {
        match bin_of(x, self.counts.len()) {
            Some(bin) => self.counts[bin] += 1,
            None => self.outside += 1,
        }
    }

    /// Adds the counts of another histogram.
    ///
    /// # Panics
    /// If the numbers of bins differ.
    pub fn merge(&mut self, other: &Self) {
        assert_eq!(self.counts.len(), other.counts.len(), "histograms to merge must have equal bins");
        self.outside += other.outside;
        for (mine, theirs) in self.counts.iter_mut().zip(&other.counts) {
            *mine += theirs;
        }
    }

    /// Sums the counts of all bins; [`outside`](Self::outside) is not part of it.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.counts.iter().sum()
    }

    /// Gives the counts, lowest bin first.
    #[must_use]
    pub fn counts(&self) -> &[u64] {
        &self.counts
    }
}

impl Extend<f64> for Histogram {
    fn extend<I: IntoIterator<Item = f64>>(&mut self, values: I) {
        values.into_iter().for_each(|x| self.add(x));
    }
}

/// Gives the bin of `x` among `bins` equal ones over `[0, 1]`; `None` for NaN and for what is outside.
#[must_use]
pub fn bin_of(x: f64, bins: usize) -> Option<usize> {
    (0.0..=1.0).contains(&x).then(|| ((x * bins as f64) as usize).min(bins - 1))
}
