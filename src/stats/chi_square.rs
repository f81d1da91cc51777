//! Pearson's chi-square: counts against probabilities, against each other, against a product law.
//!
//! All of these laws need independent observations. Pixels that share a cell of a noise field are not; take
//! one sample a cell, or divide the statistic by the design effect and build the result with
//! [`ChiSquare::new`].

use super::{StatsError, Tails};
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Smallest expected count of a bin; the chi-square law is an approximation that needs it.
const LEAST_EXPECTED: f64 = 5.0;
/// How far expected probabilities may add up to something else than 1.
const NORMALIZATION: f64 = 1e-9;

/// Holds a chi-square statistic and its judgement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChiSquare {
    /// Sum of (observed - expected)² / expected; infinite if something impossible was observed.
    pub statistic: f64,
    /// Degrees of freedom, at least 1.
    pub dof: u64,
    /// Number of observations.
    pub n: u64,
    /// Upper tail: the probability of a statistic as large or larger, in `[0, 1]`.
    ///
    /// A true tail, with a relative error below 1e-10 down to 1e-300 for up to 65 535 degrees of freedom,
    /// below 1e-9 for up to a million.
    pub p: f64,
    /// Effect size w² = max(0, statistic - dof) / n: how far off the counts are, whatever their number.
    ///
    /// Estimates Cohen's w² = Σ(true - expected)² / expected over the probabilities of the bins, with a
    /// standard error of about sqrt(2 dof) / n where the true value is 0.
    pub effect: f64,
}

impl ChiSquare {
    /// Judges a statistic that is chi-square distributed with `dof` degrees of freedom, from `n`
    /// observations.
    ///
    /// # Panics
    /// If `statistic` is negative or NaN, or `dof` or `n` is 0.
    #[must_use]
    pub fn new(statistic: f64, dof: u64, n: u64) -> Self {
        assert!(statistic >= 0.0, "chi-square statistic {statistic}");
        assert!(dof > 0 && n > 0, "{dof} degrees of freedom, {n} observations");
        let effect = (statistic - dof as f64).max(0.0) / n as f64;
        Self { statistic, dof, n, p: upper_p(statistic, dof), effect }
    }

    /// Gives the lower tail: the probability of a statistic as small or smaller.
    ///
    /// Tiny values mean counts that are too even to be random, as stratified samples are.
    #[must_use]
    pub fn lower_p(&self) -> f64 {
        lower_p(self.statistic, self.dof)
    }

    /// Gives both tails, whose [`two_sided_p`](Tails::two_sided_p) rejects uneven counts and too even ones.
    #[must_use]
    pub fn tails(&self) -> Tails {
        Tails { lower: self.lower_p(), upper: self.p }
    }
}

/// Tests whether all bins are equally likely.
///
/// Neighbouring bins are pooled like in [`against`].
///
/// # Errors
/// [`StatsError::TooFewBins`] when fewer than two bins remain, [`StatsError::Empty`] without observations.
pub fn uniform(counts: &[u64]) -> Result<ChiSquare, StatsError> {
    against(counts, &vec![1.0 / counts.len() as f64; counts.len()])
}

/// Tests whether counts follow given probabilities.
///
/// `expected` holds one probability a bin, in `[0, 1]`, summing to 1 within 1e-9. From the first bin on,
/// neighbours are pooled until the expected count is at least 5; what is left over joins the last pool. A
/// count in a bin of probability 0 is impossible and makes the statistic infinite and p 0. The degrees of
/// freedom are the bins that remain, less one.
///
/// # Errors
/// [`StatsError::LengthMismatch`], [`StatsError::NotAProbability`], [`StatsError::NotNormalized`];
/// [`StatsError::Empty`] without observations; [`StatsError::TooFewBins`] when fewer than two bins remain.
pub fn against(counts: &[u64], expected: &[f64]) -> Result<ChiSquare, StatsError> {
    if counts.len() != expected.len() {
        return Err(StatsError::LengthMismatch { left: counts.len(), right: expected.len() });
    }
    let n = observations(counts)?;
    if let Some(&value) = expected.iter().find(|q| !(0.0..=1.0).contains(*q)) {
        return Err(StatsError::NotAProbability { value });
    }
    let sum: f64 = expected.iter().sum();
    if (sum - 1.0).abs() > NORMALIZATION {
        return Err(StatsError::NotNormalized { sum });
    }
    let bins = counts.iter().zip(expected).map(|(&o, &q)| ([o as f64], q / sum * n as f64));
    let pools = pool(bins, LEAST_EXPECTED)?;
    let impossible = counts.iter().zip(expected).any(|(&o, &q)| o > 0 && q == 0.0);
    let statistic = if impossible {
        f64::INFINITY
    } else {
        pools.iter().map(|([observed], expected)| (observed - expected).powi(2) / expected).sum()
    };
    Ok(ChiSquare::new(statistic, pools.len() as u64 - 1, n))
}

/// Tests whether the row and the column of an observation are independent.
///
/// `table` holds counts row by row, `columns` to a row. Empty rows and columns are dropped; the degrees of
/// freedom are (rows - 1)(columns - 1) of the rest. Nothing is pooled: the caller chooses a table whose
/// expected counts are 5 or more. The effect is Cohen's w² (the square of phi).
///
/// # Errors
/// [`StatsError::LengthMismatch`] if the table is not a whole number of rows, [`StatsError::Empty`] without
/// observations, [`StatsError::TooFewBins`] if fewer than two rows or columns remain.
pub fn independence(table: &[u64], columns: usize) -> Result<ChiSquare, StatsError> {
    if columns == 0 || !table.len().is_multiple_of(columns) {
        return Err(StatsError::LengthMismatch { left: table.len(), right: columns });
    }
    let n = observations(table)?;
    let row_sums: Vec<u64> = table.chunks_exact(columns).map(|row| row.iter().sum()).collect();
    let column_sums: Vec<u64> = (0..columns).map(|c| table.iter().skip(c).step_by(columns).sum()).collect();
    let used = |sums: &[u64]| sums.iter().filter(|&&sum| sum > 0).count();
    let (rows, cols) = (used(&row_sums), used(&column_sums));
    if rows.min(cols) < 2 {
        return Err(StatsError::TooFewBins { bins: rows.min(cols) });
    }
    let mut statistic = 0.0;
    for (row, &row_sum) in table.chunks_exact(columns).zip(&row_sums) {
        for (&observed, &column_sum) in row.iter().zip(&column_sums) {
            let expected = row_sum as f64 * column_sum as f64 / n as f64;
            if expected > 0.0 {
                statistic += (observed as f64 - expected).powi(2) / expected;
            }
        }
    }
    Ok(ChiSquare::new(statistic, (rows as u64 - 1) * (cols as u64 - 1), n))
}

/// Tests whether two samples come from the same law, whatever it is.
///
/// The samples may differ in size. Neighbouring bins are pooled until the expected count in the smaller
/// sample is at least 5; the degrees of freedom are the bins that remain, less one. `n` is the size of both
/// together.
///
/// # Errors
/// [`StatsError::LengthMismatch`], [`StatsError::Empty`] if one of the samples is,
/// [`StatsError::TooFewBins`] when fewer than two bins remain.
pub fn two_sample(left: &[u64], right: &[u64]) -> Result<ChiSquare, StatsError> {
    if left.len() != right.len() {
        return Err(StatsError::LengthMismatch { left: left.len(), right: right.len() });
    }
    let (n_left, n_right) = (observations(left)?, observations(right)?);
    let n = n_left + n_right;
    let (share_left, share_right) = (n_left as f64 / n as f64, n_right as f64 / n as f64);
    let bins = left.iter().zip(right).map(|(&l, &r)| ([l as f64, r as f64], (l + r) as f64));
    let pools = pool(bins, LEAST_EXPECTED / share_left.min(share_right))?;
    let statistic = pools
        .iter()
        .map(|([l, _], both)| (l - share_left * both).powi(2) / (share_left * share_right * both))
        .sum();
    Ok(ChiSquare::new(statistic, pools.len() as u64 - 1, n))
}

/// Sums neighbours until each pool weighs at least `least`; what is left over joins the last pool.
fn pool<const N: usize>(
    bins: impl Iterator<Item = ([f64; N], f64)>,
    least: f64,
) -> Result<Vec<([f64; N], f64)>, StatsError> {
    let join = |a: ([f64; N], f64), b: ([f64; N], f64)| (std::array::from_fn(|i| a.0[i] + b.0[i]), a.1 + b.1);
    let empty = ([0.0; N], 0.0);
    let (mut pools, mut open) = (Vec::new(), empty);
    for bin in bins {
        open = join(open, bin);
        if open.1 >= least {
            pools.push(std::mem::replace(&mut open, empty));
        }
    }
    if let Some(last) = pools.last_mut() {
        *last = join(*last, open);
    }
    if pools.len() < 2 { Err(StatsError::TooFewBins { bins: pools.len() }) } else { Ok(pools) }
}

fn observations(counts: &[u64]) -> Result<u64, StatsError> {
    match counts.iter().sum() {
        0 => Err(StatsError::Empty),
        n => Ok(n),
    }
}

/// Upper tail of the chi-square law at `statistic` >= 0.
pub(super) fn upper_p(statistic: f64, dof: u64) -> f64 {
    if statistic.is_infinite() { 0.0 } else { law(dof).sf(statistic) }
}

/// Lower tail of the chi-square law at `statistic` >= 0.
fn lower_p(statistic: f64, dof: u64) -> f64 {
    if statistic.is_infinite() { 1.0 } else { law(dof).cdf(statistic) }
}

/// Both tails of the chi-square law at `statistic` >= 0.
pub(super) fn tails(statistic: f64, dof: u64) -> Tails {
    Tails { lower: lower_p(statistic, dof), upper: upper_p(statistic, dof) }
}

fn law(dof: u64) -> ChiSquared {
    ChiSquared::new(dof as f64).expect("positive degrees of freedom")
}
