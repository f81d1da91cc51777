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
    Moments::of(x, y).correlation()
}

/// Means and sums of products of two sequences, which add up chunk by chunk.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Moments {
    n: u64,
    means: [f64; 2],
    /// Sums over the pairs of (x - mean)², (y - mean)² and of the product of both.
    squares: [f64; 2],
    product: f64,
}

impl Moments {
    /// Measures two sequences; what the longer one has beyond the other is left out.
    #[must_use]
    pub fn of(x: &[f64], y: &[f64]) -> Self {
        let n = x.len().min(y.len());
        if n == 0 {
            return Self::default();
        }
        let mean_x = x[..n].iter().sum::<f64>() / n as f64;
        let mean_y = y[..n].iter().sum::<f64>() / n as f64;
        let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
        for (x, y) in x.iter().zip(y) {
            let (x, y) = (x - mean_x, y - mean_y);
            xx += x * x;
            yy += y * y;
            xy += x * y;
        }
        Self { n: n as u64, means: [mean_x, mean_y], squares: [xx, yy], product: xy }
    }

    /// Adds further pairs.
    ///
    /// Source: Chan, Golub and LeVeque 1979.
    pub fn merge(&mut self, other: &Self) {
        if self.n == 0 {
            *self = *other;
            return;
        }
        let (here, there) = (self.n as f64, other.n as f64);
        let whole = here + there;
        let apart = [0, 1].map(|i| other.means[i] - self.means[i]);
        let weight = here * there / whole;
        for i in [0, 1] {
            self.squares[i] += other.squares[i] + apart[i] * apart[i] * weight;
            self.means[i] += apart[i] * there / whole;
        }
        self.product += other.product + apart[0] * apart[1] * weight;
        self.n += other.n;
    }

    /// Judges the linear correlation, as [`pearson`] does.
    ///
    /// # Errors
    /// [`StatsError::Empty`] for fewer than 3 pairs, [`StatsError::Constant`] if one of the sequences does not vary (or is not
    /// finite).
    pub fn correlation(&self) -> Result<Correlation, StatsError> {
        if self.n < 3 {
            return Err(StatsError::Empty);
        }
        let scale = self.squares[0].sqrt() * self.squares[1].sqrt();
        if !(scale > 0.0 && scale.is_finite()) {
            return Err(StatsError::Constant);
        }
        let r = (self.product / scale).clamp(-1.0, 1.0);
        let z = r * (self.n as f64 - 1.0).sqrt();
        Ok(Correlation { r, n: self.n, z, p: normal::two_sided_p(z) })
    }
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
