//! The empirical distribution function against the uniform law: Kolmogorov-Smirnov.

use super::StatsError;
use super::binomial::{binomial_pmf, poisson_pmf};
use super::histogram::Histogram;
use std::f64::consts::PI;

/// Largest sample for which the bulk of the law is computed exactly (some milliseconds at the limit).
const EXACT_BULK: u64 = 1000;
/// Largest sample for which the tail of the law is summed exactly (some 10 milliseconds at the limit).
const EXACT_TAIL: u64 = 100_000;
/// n d² from which p is twice the one-sided tail: what both sides exceed together is below 1e-10 of it.
const TAIL: f64 = 4.0;

/// Holds a Kolmogorov-Smirnov distance from the uniform law and its judgement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KolmogorovSmirnov {
    /// The largest distance of the empirical distribution function from x, on either side of a step, in `[0,
    /// 1]`.
    pub d: f64,
    /// Number of values.
    pub n: u64,
    /// Probability of a distance as large or larger, in `[0, 1]`; accuracy in [`kolmogorov_smirnov`].
    pub p: f64,
    /// The bound min(1, 2 exp(-2 n d²)) of Dvoretzky, Kiefer, Wolfowitz and Massart: never less than the true
    /// p.
    pub dkwm: f64,
}

/// Measures how far values are from uniform on `[0, 1]`. Sorts them.
///
/// Ties are handled exactly in the distance; for a discrete source the p-value is then too large, never too
/// small.
///
/// The p-value is exact for n up to 1000, and for n up to 100 000 where n d² >= 4 (p below 7e-4): relative
/// error below 1e-9 down to 1e-300. Elsewhere it comes from expansions. In the bulk, for n above 1000, the
/// error is below .022/n, and below 3/n relative to p; in the tail, for n above 100 000, it is below 5e-4
/// relative to p.
///
/// Sources: for the distance, Kolmogorov 1933; the exact bulk by the Poisson process that stays in a band
/// (the idea of Pomeranz 1974); the exact tail by Smirnov's one-sided formula (Birnbaum and Tingey 1951),
/// doubled (Simard and L'Ecuyer 2011); the expansion of the bulk by Vrbik 2018, that of the tail by Maag and
/// Dicaire 1971 with the next term of the large-deviation rate.
///
/// # Errors
/// [`StatsError::Empty`] without values, [`StatsError::NotAProbability`] if one is NaN or not in `[0, 1]`.
pub fn kolmogorov_smirnov(values: &mut [f64]) -> Result<KolmogorovSmirnov, StatsError> {
    sort_unit(values)?;
    let n = values.len() as f64;
    let d = values
        .iter()
        .enumerate()
        .map(|(i, &x)| ((i + 1) as f64 / n - x).max(x - i as f64 / n))
        .fold(0.0, f64::max);
    let dkwm = (2.0 * libm::exp(-2.0 * n * d * d)).min(1.0);
    let n = values.len() as u64;
    Ok(KolmogorovSmirnov { d, n, p: upper_p(d, n), dkwm })
}

/// Measures how far values in bins are from uniform on `[0, 1]`, at the edges of the bins alone.
///
/// Returns the distance of the edge where it is largest, which is at most that of the values themselves; so both
/// probabilities are never too small.
///
/// # Errors
/// [`StatsError::Empty`] without values.
pub fn distance_at_edges(counts: &Histogram) -> Result<KolmogorovSmirnov, StatsError> {
    let n = counts.total();
    if n == 0 {
        return Err(StatsError::Empty);
    }
    let bins = counts.counts().len() as f64;
    let (mut below, mut d) = (0_u64, 0.0_f64);
    for (bin, count) in counts.counts().iter().enumerate() {
        d = d.max((below as f64 / n as f64 - bin as f64 / bins).abs());
        below += count;
    }
    let dkwm = (2.0 * libm::exp(-2.0 * n as f64 * d * d)).min(1.0);
    Ok(KolmogorovSmirnov { d, n, p: upper_p(d, n), dkwm })
}

/// Measures how far values are from the exponential law of mean 1. Replaces them by their uniform images, 1 -
/// exp(-x), sorted.
///
/// # Errors
/// [`StatsError::Empty`] without values, [`StatsError::NotAProbability`] with the image of one that is NaN or
/// negative.
pub fn kolmogorov_smirnov_exponential(values: &mut [f64]) -> Result<KolmogorovSmirnov, StatsError> {
    values.iter_mut().for_each(|x| *x = -libm::expm1(-*x));
    kolmogorov_smirnov(values)
}

/// Gives the distance that `n` uniform values exceed with probability at most `alpha`: sqrt(ln(2/alpha) /
/// (2n)).
///
/// Valid for every `n`, by the inequality of Dvoretzky, Kiefer and Wolfowitz with Massart's constant.
///
/// # Panics
/// If `n` is 0 or `alpha` is not in `(0, 1]`.
#[must_use]
pub fn dkwm_distance(n: u64, alpha: f64) -> f64 {
    assert!(n > 0 && alpha > 0.0 && alpha <= 1.0, "n {n}, alpha {alpha}");
    (libm::log(2.0 / alpha) / (2.0 * n as f64)).sqrt()
}

/// Sorts values, all of which have to be in `[0, 1]`.
pub(super) fn sort_unit(values: &mut [f64]) -> Result<(), StatsError> {
    if values.is_empty() {
        return Err(StatsError::Empty);
    }
    if let Some(&value) = values.iter().find(|x| !(0.0..=1.0).contains(*x)) {
        return Err(StatsError::NotAProbability { value });
    }
    values.sort_unstable_by(f64::total_cmp);
    Ok(())
}

/// Gives the probability that `n` uniform values have a distance of at least `d`; accuracy as in
/// [`kolmogorov_smirnov`].
///
/// # Panics
/// If `n` is 0 or `d` is NaN.
#[must_use]
pub fn upper_p(d: f64, n: u64) -> f64 {
    assert!(n > 0 && !d.is_nan(), "n {n}, d {d}");
    let tail = n as f64 * d * d >= TAIL;
    let p = match (tail, n) {
        _ if d >= 1.0 => 0.0,
        (true, ..=EXACT_TAIL) => 2.0 * one_sided(d, n),
        (true, _) => 2.0 * one_sided_expansion(d, n),
        (false, ..=EXACT_BULK) => 1.0 - stays_in_band(d, n),
        (false, _) => bulk_expansion(d, n),
    };
    p.clamp(0.0, 1.0)
}

/// P(D < d), exactly, with an absolute error of some 1e-13.
///
/// The order statistics of n uniforms are the arrivals of a Poisson process of rate 1 on `[0, n]`, given that
/// it ends at n. D < d means that its count N(t) stays strictly between t - c and t + c, c = nd. The band
/// admits level i at t = i - c and drops it at t = i + c; in between the count grows freely by a Poisson
/// number.
fn stays_in_band(d: f64, n: u64) -> f64 {
    let (end, c) = (n as f64, n as f64 * d);
    if c <= 0.5 {
        return 0.0;
    }
    let levels = n as usize;
    let mut weight = vec![0.0; levels + 1];
    weight[0] = 1.0;
    let (mut low, mut high) = (0, (c as usize).min(levels));
    let mut now = 0.0;
    loop {
        let admits = if high < levels { (high + 1) as f64 - c } else { f64::INFINITY };
        let drops = low as f64 + c;
        let next = admits.min(drops).min(end);
        grow(&mut weight[low..=high], next - now);
        if next >= end {
            return weight[levels] / poisson_pmf(n, end);
        }
        if admits <= next {
            high += 1;
        }
        if drops <= next {
            low += 1;
        }
        now = next;
    }
}

/// Lets a count grow for a time of at most 1: convolves its law with the Poisson law of that mean.
fn grow(weight: &mut [f64], time: f64) {
    // 1/22! is 1e-21: longer jumps leave no trace.
    let mut jump = [libm::exp(-time); 23];
    for j in 1..jump.len() {
        jump[j] = jump[j - 1] * time / j as f64;
    }
    for level in (0..weight.len()).rev() {
        weight[level] = jump.iter().zip(weight[..=level].iter().rev()).map(|(j, w)| j * w).sum();
    }
}

/// P(one-sided distance >= d), exactly. All terms are positive.
fn one_sided(d: f64, n: u64) -> f64 {
    let term = |j| {
        let x = d + j as f64 / n as f64;
        if x > 1.0 { 0.0 } else { binomial_pmf(j, n, x) * d / x }
    };
    (0..=(n as f64 * (1.0 - d)) as u64).map(term).sum()
}

/// P(one-sided distance >= d) for large n.
fn one_sided_expansion(d: f64, n: u64) -> f64 {
    let n = n as f64;
    libm::exp(-2.0 * (n * d + 1.0 / 6.0).powi(2) / n - 4.0 / 9.0 * n * d.powi(4))
}

/// P(D >= d) for large n, outside the tail: the limit law at a corrected argument.
fn bulk_expansion(d: f64, n: u64) -> f64 {
    let n = n as f64;
    let z = d * n.sqrt();
    limit_upper_p(z + 1.0 / (6.0 * n.sqrt()) + (z - 1.0) / (4.0 * n))
}

/// Gives the probability that sqrt(n) times the distance is at least `z`, in the limit of large n: Kolmogorov's
/// law.
///
/// A true tail: relative error below 1e-10 down to 1e-300. For two samples, n is m n / (m + n).
///
/// # Panics
/// If `z` is NaN.
#[must_use]
pub fn limit_upper_p(z: f64) -> f64 {
    assert!(!z.is_nan(), "z is NaN");
    if z < 0.04 {
        return 1.0; // The complement is below 1e-300.
    }
    if z < 1.0 {
        let q = |k: i32| libm::exp(-(f64::from(2 * k - 1) * PI / z).powi(2) / 8.0);
        return 1.0 - (2.0 * PI).sqrt() / z * (1..=6).map(q).sum::<f64>();
    }
    2.0 * (1..=6)
        .map(|k: i32| (-1.0_f64).powi(k - 1) * libm::exp(-2.0 * (f64::from(k) * z).powi(2)))
        .sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_close(actual: f64, expected: f64, relative: f64) {
        assert!((actual / expected - 1.0).abs() <= relative, "{actual:e} is not {expected:e}");
    }

    #[test]
    fn edges_see_no_more_than_the_values_do() {
        let mut values: Vec<f64> = (0..1000).map(|i| f64::from(i * i) / 1.0e6).collect();
        let distance = |bins| {
            let mut counts = Histogram::new(bins);
            counts.extend(values.iter().copied());
            distance_at_edges(&counts).unwrap()
        };
        let found = [2, 64, 1 << 20].map(|bins| distance(bins).d);
        assert!((found[0] - (0.5_f64.sqrt() - 0.5)).abs() < 2e-3, "{found:?}");
        let exact = kolmogorov_smirnov(&mut values).unwrap();
        assert!(found[0] <= found[1] && found[1] <= found[2] && found[2] <= exact.d, "{found:?} {exact:?}");
        assert!(exact.d - found[2] < 2e-3);
        assert_eq!(distance_at_edges(&Histogram::new(4)), Err(StatsError::Empty));
    }

    #[test]
    fn the_bulk_meets_the_tail() {
        for n in [5, 10, 100, 1000] {
            let d = (TAIL / n as f64).sqrt();
            if d < 1.0 {
                assert_close(2.0 * one_sided(d, n), 1.0 - stays_in_band(d, n), 1e-9);
            }
        }
    }

    #[test]
    fn expansions_meet_the_exact_law() {
        for n in [1000, 3000] {
            for i in 1..40 {
                let d = f64::from(i) * 0.05 / (n as f64).sqrt();
                let (exact, ours) = (1.0 - stays_in_band(d, n), bulk_expansion(d, n));
                assert!((ours - exact).abs() < 0.022 / n as f64, "n {n} d {d}: {ours} {exact}");
                assert_close(ours, exact, 3.0 / n as f64);
            }
        }
        for nd2 in [4.0, 10.0, 35.0, 100.0, 350.0] {
            let d = (nd2 / EXACT_TAIL as f64).sqrt();
            assert_close(one_sided_expansion(d, EXACT_TAIL), one_sided(d, EXACT_TAIL), 5e-4);
        }
    }
}
