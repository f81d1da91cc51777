//! The largest of many exponential ordinates: Fisher's g, the test for one hidden tone.

use super::StatsError;
use super::binomial::poisson_pmf;
use std::f64::consts::PI;

/// Expected number of ordinates above the largest from which on the alternating series has lost digits.
const SERIES: f64 = 2.0;
/// The same number from which on p is 1 to the last bit: the ordinates are negatively associated, so that all of
/// them stay below g of the sum with probability exp(-40) at most.
const CERTAIN: f64 = 40.0;
/// Ordinates up to which it never loses many: their terms add up to 2^16 at most.
const FEW: u64 = 16;

/// Holds Fisher's g and its judgement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FisherG {
    /// The largest ordinate divided by the sum of all, in `(0, 1]`.
    pub g: f64,
    /// Position of the largest.
    pub at: usize,
    /// Number of ordinates.
    pub n: u64,
    /// Probability of a g as large or larger, in `[0, 1]`, if the ordinates are independent and exponential of
    /// equal mean.
    pub p: f64,
}

/// Tests whether the largest ordinate is too large for its sum.
///
/// The law is exact for every number of ordinates, whatever their common mean. Source: Fisher 1929, Proc. R.
/// Soc. A 125.
///
/// # Errors
/// [`StatsError::Empty`] without ordinates, [`StatsError::NotFinite`] for one that is NaN, infinite or
/// negative, [`StatsError::Constant`] if all are 0.
pub fn fisher_g(ordinates: &[f64]) -> Result<FisherG, StatsError> {
    if let Some(&value) = ordinates.iter().find(|x| !(**x >= 0.0 && x.is_finite())) {
        return Err(StatsError::NotFinite { value });
    }
    let largest = ordinates.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
    let (at, &value) = largest.ok_or(StatsError::Empty)?;
    let sum: f64 = ordinates.iter().sum();
    if sum <= 0.0 {
        return Err(StatsError::Constant);
    }
    let n = ordinates.len() as u64;
    let g = value / sum;
    Ok(FisherG { g, at, n, p: upper_p(g, n) })
}

/// Gives the probability that the largest of `n` exponential ordinates is at least `g` of their sum.
///
/// A true tail: relative error below 1e-10 down to 1e-300, for up to 100 million ordinates.
///
/// # Panics
/// If `n` is 0 or `g` is NaN.
#[must_use]
pub fn upper_p(g: f64, n: u64) -> f64 {
    assert!(n > 0 && !g.is_nan(), "g {g} of {n}");
    if g * n as f64 <= 1.0 {
        return 1.0;
    }
    if g >= 1.0 {
        return if n == 1 { 1.0 } else { 0.0 };
    }
    let expected = n as f64 * libm::exp((n - 1) as f64 * libm::log1p(-g));
    let p = match expected {
        _ if n <= FEW => series(g, n),
        ..=SERIES => series(g, n),
        ..=CERTAIN => 1.0 - none_above(g, n),
        _ => 1.0,
    };
    p.clamp(0.0, 1.0)
}

/// Fisher's sum: over j of (-1)^(j+1) (n over j) (1 - j g)^(n-1), while 1 - j g is positive.
fn series(g: f64, n: u64) -> f64 {
    let (mut sum, mut choices) = (0.0, 1.0);
    for j in 1..=n {
        let rest = j as f64 * g;
        if rest >= 1.0 {
            break;
        }
        choices *= -((n - j + 1) as f64) / j as f64;
        let term = choices * libm::exp((n - 1) as f64 * libm::log1p(-rest));
        sum -= term;
        if term.abs() <= 1e-18 * sum {
            break;
        }
    }
    sum
}

/// P(no ordinate is above g of the sum), with an absolute error of some 1e-13, for many ordinates.
///
/// The sum of n exponentials does not depend on their shares, so let it be n. Then this is the density at n of
/// the sum of n exponentials cut off at c = g n, divided by that of uncut ones. The first is the Fourier
/// integral of (φ(t) exp(-i t))^n with φ(t) = (1 - exp(-c + i c t)) / (1 - i t), and the trapezoidal rule
/// integrates it to full precision: a step h adds the densities at n + 2πk/h, which are nothing.
fn none_above(g: f64, n: u64) -> f64 {
    let count = n as f64;
    let cut = g * count;
    // The densities that are added are 14 standard deviations away, or below 0.
    let step = 2.0 * PI / (14.0 * count.sqrt() + 60.0);
    // From here on (1 + t²)^(-n/2) is below exp(-80).
    let reach = libm::expm1(160.0 / count).sqrt();
    let value = |t: f64| {
        let (re, im) = (-libm::exp(-cut) * libm::cos(cut * t), -libm::exp(-cut) * libm::sin(cut * t));
        let log_modulus = 0.5 * (libm::log1p(re * (2.0 + re) + im * im) - libm::log1p(t * t));
        let angle = libm::atan2(im, 1.0 + re) + libm::atan(t) - t;
        libm::exp(count * log_modulus) * libm::cos(count * angle)
    };
    let nodes = (reach / step) as u32;
    let integral = 0.5 * value(0.0) + (1..=nodes).map(|i| value(f64::from(i) * step)).sum::<f64>();
    // The density of the whole sum at n is n^n exp(-n) / n!, a Poisson probability.
    integral * step / PI / poisson_pmf(n, count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_meets_the_integral() {
        for n in [17, 50, 1000, 100_000] {
            for expected in [0.5, 2.0, 5.0] {
                let g = libm::log(n as f64 / expected) / n as f64;
                let (series, integral) = (series(g, n), 1.0 - none_above(g, n));
                assert!((series - integral).abs() < 1e-12, "n {n} g {g}: {series} {integral}");
            }
        }
    }
}
