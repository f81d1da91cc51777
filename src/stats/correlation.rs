//! Relation of two sequences: linear correlation, and the table of pairs for a serial test.

use super::{StatsError, histogram, normal};

/// Holds a sample correlation and its judgement against independence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Correlation {
    /// Pearson's coefficient, in `[-1, 1]`.
    pub r: f64,
    /// Number of pairs.
    pub n: u64,
    /// `r * sqrt(n - 1)`: mean 0 and variance 1 when the sequences are independent, whatever their laws.
    pub z: f64,
    /// Two-sided p-value of `z` by the normal law, which holds in the limit of many pairs.
    pub p: f64,
}

/// Measures the linear correlation of two sequences of equal length.
///
/// In the tail the normal law errs on the safe side for uniform values: p is too large by a factor of about
/// exp(z⁴/(5n)), which is 1.03 at p = 1e-9 and 10 000 pairs.
///
/// # Errors
/// [`StatsError::LengthMismatch`], [`StatsError::Empty`] for fewer than 3 pairs, [`StatsError::Constant`] if
/// one of the sequences does not vary (or is not finite).
pub fn pearson(x: &[f64], y: &[f64]) -> Result<Correlation, StatsError> {
    if x.len() != y.len() {
        return Err(StatsError::LengthMismatch { left: x.len(), right: y.len() });
    }
    if x.len() < 3 {
        return Err(StatsError::Empty);
    }
    let n = x.len() as f64;
    let mean_x = x.iter().sum::<f64>() / n;
    let mean_y = y.iter().sum::<f64>() / n;
    let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
    for (x, y) in x.iter().zip(y) {
        let (x, y) = (x - mean_x, y - mean_y);
        xx += x * x;
        yy += y * y;
        xy += x * y;
    }
    let scale = xx.sqrt() * yy.sqrt();
    if !(scale > 0.0 && scale.is_finite()) {
        return Err(StatsError::Constant);
    }
    let r = (xy / scale).clamp(-1.0, 1.0);
    let z = r * (n - 1.0).sqrt();
    Ok(Correlation { r, n: x.len() as u64, z, p: normal::two_sided_p(z) })
}

/// Counts pairs of values in a square table of `bins` by `bins` equal cells over `[0, 1]²`.
///
/// Row-major: the pair `(u, v)` is in row `bin(u)` and column `bin(v)`, with the bins of
/// [`Histogram`](super::histogram::Histogram). Pairs with a member that is NaN or outside are left out, so
/// the sum of the table tells how many there were. The table is made for [`chi_square`](super::chi_square),
/// whose laws hold when the pairs are disjoint.
///
/// # Panics
/// If `bins` is 0.
#[must_use]
pub fn pair_table(pairs: impl IntoIterator<Item = (f64, f64)>, bins: usize) -> Vec<u64> {
    assert!(bins > 0, "a table needs a cell");
    let mut table = vec![0; bins * bins];
    for (u, v) in pairs {
        if let (Some(row), Some(column)) = (histogram::bin_of(u, bins), histogram::bin_of(v, bins)) {
            table[row * bins + column] += 1;
        }
    }
    table
}

#[cfg(test)]
mod tests {
    use super::super::calibration::{assert_close, assert_uniform_p};
    use super::super::seed::{rng, uniform01};
    use super::*;

    /// scipy.stats.pearsonr.
    #[test]
    fn r_matches_a_reference() {
        let c = pearson(&[1.0, 2.0, 3.0, 4.0, 5.0], &[2.0, 1.0, 4.0, 3.0, 7.0]).unwrap();
        assert_close(c.r, 0.8241633836921339, 1e-14);
        assert_close(c.z, 2.0 * c.r, 1e-15);
    }

    #[test]
    fn degenerate_sequences_are_refused() {
        assert_eq!(pearson(&[1.0; 5], &[1.0, 2.0, 3.0, 4.0, 5.0]), Err(StatsError::Constant));
        assert_eq!(pearson(&[1.0, 2.0], &[1.0, 2.0]), Err(StatsError::Empty));
        assert_eq!(pearson(&[1.0], &[]), Err(StatsError::LengthMismatch { left: 1, right: 0 }));
        assert_eq!(pearson(&[1.0, f64::NAN, 2.0], &[1.0, 2.0, 4.0]), Err(StatsError::Constant));
    }

    #[test]
    fn p_is_uniform_on_an_ideal_source() {
        assert_uniform_p("stats.correlation.pearson", |rng| {
            let x: Vec<f64> = (0..200).map(|_| uniform01(rng)).collect();
            let y: Vec<f64> = (0..200).map(|_| uniform01(rng)).collect();
            pearson(&x, &y).unwrap().p
        });
    }

    /// A tenth of the values is copied: correlation .1, z = 10 at 10 000 pairs.
    #[test]
    fn a_sequence_that_leaks_is_rejected() {
        let mut rng = rng("stats.correlation.leak", 0);
        let x: Vec<f64> = (0..10_000).map(|_| uniform01(&mut rng)).collect();
        let y: Vec<f64> =
            x.iter().map(|&x| if uniform01(&mut rng) < 0.1 { x } else { uniform01(&mut rng) }).collect();
        assert!(pearson(&x, &y).unwrap().p < 1e-9);
    }

    #[test]
    fn pairs_are_counted_by_row_and_column() {
        let table = pair_table([(0.0, 0.9), (1.0, 0.0), (0.2, 1.0), (f64::NAN, 0.5), (0.5, 2.0)], 2);
        assert_eq!(table, [0, 2, 1, 0]);
    }
}
