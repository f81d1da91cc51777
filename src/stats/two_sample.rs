//! Two empirical distribution functions against each other: Kolmogorov-Smirnov of two samples.
//!
//! Binned counts of two samples are compared by [`chi_square::two_sample`](super::chi_square::two_sample);
//! pairs of yes and no by [`binomial::two_sided_p`](super::binomial::two_sided_p) of the pairs that say yes
//! once on the left among all that disagree, at 1/2 (the exact test of McNemar, or of signs).

use super::{StatsError, ecdf};

/// Steps of the walk inside the band up to which p is exact (a second at the limit).
const EXACT_STEPS: f64 = 1e8;

/// Holds the Kolmogorov-Smirnov distance of two samples and its judgement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoSampleKs {
    /// The largest distance of the two empirical distribution functions, in `[0, 1]`.
    pub d: f64,
    /// Sizes of the two samples.
    pub n: [u64; 2],
    /// Probability of a distance as large or larger if both samples follow one continuous law, in `[0, 1]`;
    /// accuracy in [`kolmogorov_smirnov`].
    pub p: f64,
    /// Tells whether [`p`](Self::p) is exact; otherwise it is the limit law.
    pub is_exact: bool,
}

/// Measures how far two samples are from each other. Sorts them.
///
/// Any finite values will do. Ties are handled exactly in the distance; for a discrete law the p-value is
/// then too large, never too small.
///
/// The p-value is exact, with a relative error below 1e-10 down to 1e-300, while 2 m n d is at most 1e8: for
/// two samples of up to 40 000 as long as p is above 1e-12, for two of up to 7000 always. Beyond, it is the
/// limit law. That errs on the safe side: where both sizes exceed 10 000 and p is above 1e-12, it is too large
/// by a relative 2 z / sqrt(n) at most, with z = d sqrt(m n / (m + n)) and n the smaller size, and never too
/// small by more than 1/n.
///
/// The exact law is that of a walk that merges the samples in random order. The probabilities of its first
/// steps out of a band are summed; all are positive, so a tail is a true tail. Source: Hodges 1958, Ark. Mat.
/// 3.
///
/// # Errors
/// [`StatsError::Empty`] if one of the samples is, [`StatsError::NotFinite`] for NaN and infinities.
pub fn kolmogorov_smirnov(left: &mut [f64], right: &mut [f64]) -> Result<TwoSampleKs, StatsError> {
    for sample in [&mut *left, &mut *right] {
        if sample.is_empty() {
            return Err(StatsError::Empty);
        }
        if let Some(&value) = sample.iter().find(|x| !x.is_finite()) {
            return Err(StatsError::NotFinite { value });
        }
        sample.sort_unstable_by(f64::total_cmp);
    }
    let n = [left.len() as u64, right.len() as u64];
    let distance = largest_distance(left, right);
    let product = n[0] as f64 * n[1] as f64;
    let d = distance as f64 / product;
    let is_exact = 2.0 * distance as f64 <= EXACT_STEPS;
    let p = if is_exact { upper_p(distance as u64, n) } else { limit_law(d, n) };
    Ok(TwoSampleKs { d, n, p, is_exact })
}

/// The largest |i n - j m| over the values of both sorted samples, i of m and j of n being at most the value.
fn largest_distance(left: &[f64], right: &[f64]) -> u128 {
    let (m, n) = (left.len() as u128, right.len() as u128);
    let (mut i, mut j, mut largest) = (0, 0, 0);
    while i < left.len() && j < right.len() {
        let value = left[i].min(right[j]);
        i += left[i..].iter().take_while(|&&x| x == value).count();
        j += right[j..].iter().take_while(|&&x| x == value).count();
        largest = largest.max((i as u128 * n).abs_diff(j as u128 * m));
    }
    largest
}

/// P(D >= d) in the limit of large samples.
fn limit_law(d: f64, n: [u64; 2]) -> f64 {
    let [m, n] = n.map(|n| n as f64);
    ecdf::limit_upper_p(d * (m * n / (m + n)).sqrt())
}

/// Gives the probability that two samples of the given sizes m and n have a distance of at least `distance / (m
/// n)`, exactly.
///
/// The merged samples are a walk from (0, 0) to (m, n), all walks being equally likely. It leaves the band at
/// its first point (i, j) with |i n - j m| >= distance. Takes about 2 `distance` steps.
///
/// # Panics
/// If a size is 0.
#[must_use]
pub fn upper_p(distance: u64, sizes: [u64; 2]) -> f64 {
    assert!(sizes[0] > 0 && sizes[1] > 0, "samples of {sizes:?}");
    if distance == 0 {
        return 1.0;
    }
    // Columns are kept in memory, so let there be few.
    let (rows, columns) = (sizes[0].max(sizes[1]), sizes[0].min(sizes[1]));
    let first_column = |row: u64| (row * columns + rows).saturating_sub(distance) / rows;
    let last_column = |row: u64| ((row * columns + distance).div_ceil(rows) - 1).min(columns);
    let mut weight = vec![0.0; columns as usize + 1];
    weight[0] = 1.0;
    let mut left_band = 0.0;
    for row in 0..=rows {
        let (last, next_first) = (last_column(row), first_column(row + 1));
        let mut from_the_left = 0.0;
        for column in first_column(row)..=last {
            let slot = &mut weight[column as usize];
            let steps = (rows - row + columns - column).max(1) as f64;
            let here = (*slot + from_the_left) / steps;
            let (right, up) = (here * (columns - column) as f64, here * (rows - row) as f64);
            from_the_left = right;
            if column == last {
                left_band += right;
            }
            *slot = up;
            if column < next_first {
                left_band += up;
            }
        }
    }
    left_band.min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two large samples, of equal size, of sizes with a common factor, and without.
    #[test]
    fn the_limit_law_errs_on_the_safe_side() {
        for (m, n, common) in [(10_000_u32, 10_000_u32, 10_000), (15_000, 10_000, 5000), (10_000, 9973, 1)] {
            for z in [0.5, 1.0, 2.0, 3.7] {
                let product = f64::from(m * n);
                let distance = (z * (f64::from(m + n) * product).sqrt()) as u64 / common * common;
                let sizes = [u64::from(m), u64::from(n)];
                let excess = limit_law(distance as f64 / product, sizes) / upper_p(distance, sizes) - 1.0;
                let least = f64::from(m.min(n));
                assert!(excess > -1.0 / least, "{m} {n} {z}: {excess}");
                assert!(excess < 2.0 * z / least.sqrt(), "{m} {n} {z}: {excess}");
            }
        }
    }
}
