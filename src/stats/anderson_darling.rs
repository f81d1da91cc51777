//! The empirical distribution function against the uniform law, with the weight on the ends of the interval:
//! Anderson-Darling.

use super::{StatsError, ecdf};
use std::f64::consts::PI;

/// Values are kept this far from 0 and 1, where the statistic has poles: half the spacing of a 24-bit grid.
const CLIP: f64 = 1.0 / (1_u64 << 25) as f64;

/// Holds an Anderson-Darling statistic for the uniform law and its judgement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AndersonDarling {
    /// A², at least 0: n times the mean of (empirical - x)² / (x (1 - x)).
    pub a2: f64,
    /// Number of values.
    pub n: u64,
    /// Probability of a statistic as large or larger, in `[0, 1]`, by the limit law.
    pub p: f64,
}

/// Measures how far values are from uniform on `[0, 1]`, mostly at the ends. Sorts them.
///
/// Values are clipped to [2^-25, 1 - 2^-25], so that exact zeros and ones of a source of 24 bits weigh as
/// they should and not infinitely. The law of A² is that of n → ∞: at n values p is off by at most .042/n, at
/// n = 10 by .0042 in the middle and 7e-5 at p = 1e-3 (simulated; Marsaglia and Marsaglia 2004 fit the same).
/// Use 100 values or more.
///
/// # Errors
/// [`StatsError::Empty`] without values, [`StatsError::NotAProbability`] if one is NaN or not in `[0, 1]`.
pub fn anderson_darling(values: &mut [f64]) -> Result<AndersonDarling, StatsError> {
    ecdf::sort_unit(values)?;
    let n = values.len() as f64;
    let clipped = |x: f64| x.clamp(CLIP, 1.0 - CLIP);
    let sum: f64 = values
        .iter()
        .zip(values.iter().rev())
        .enumerate()
        .map(|(i, (&low, &high))| {
            (2 * i + 1) as f64 * (libm::log(clipped(low)) + libm::log1p(-clipped(high)))
        })
        .sum();
    let a2 = (-n - sum / n).max(0.0);
    Ok(AndersonDarling { a2, n: values.len() as u64, p: upper_p(a2) })
}

/// Gives the probability that A² is at least `a2`, in the limit of many values.
///
/// A true tail: relative error below 1e-12 from a2 = 1 (p = .36) down to 1e-300; absolute error below 1e-13
/// before.
///
/// A² is distributed like Σ Yⱼ²/(j(j+1)) with independent standard normal Yⱼ, whose moment generating
/// function is closed: Π(1 - u/(j(j+1))) = -cos(π sqrt(1+4u) / 2)/(π u). Smirnov's inversion formula for such
/// sums gives, after u = x(x+1), an alternating series of integrals over the intervals [2k-1, 2k],
///
///   p = π^(-1/2) Σ (-1)^(k+1) ∫ (2x+1) exp(-a2 x(x+1)/2) / sqrt(x(x+1) |sin πx|) dx,
///
/// and the substitution x = 2k-1 + sin²(θ/2) makes each of them a smooth periodic one, which the midpoint
/// rule integrates to full precision.
///
/// # Panics
/// If `a2` is NaN.
#[must_use]
pub fn upper_p(a2: f64) -> f64 {
    assert!(!a2.is_nan(), "a2 is NaN");
    if a2 < 0.02 {
        return 1.0; // The complement is below 1e-25.
    }
    if a2 > 750.0 {
        return 0.0; // Below the smallest f64.
    }
    // The integrand is as narrow as 1/sqrt(a2).
    let nodes = 40 + (6.0 * a2.sqrt()) as u32;
    let integral = |k: u32| -> f64 {
        let start = f64::from(2 * k - 1);
        (0..nodes)
            .map(|i| {
                let half_angle = PI * (f64::from(i) + 0.5) / f64::from(2 * nodes);
                let (sine, cosine) = (libm::sin(half_angle), libm::cos(half_angle));
                let x = start + sine * sine;
                let area = x * (x + 1.0);
                let distance_to_integer = (sine * sine).min(cosine * cosine);
                let root = (area * libm::sin(PI * distance_to_integer)).sqrt();
                (2.0 * x + 1.0) * libm::exp(-0.5 * a2 * area) / root * sine * cosine
            })
            .sum::<f64>()
            * (PI / f64::from(nodes))
    };
    let (mut sum, mut sign) = (0.0, 1.0);
    for k in 1.. {
        let term = integral(k);
        sum += sign * term;
        if term <= 1e-17 * sum {
            break;
        }
        sign = -sign;
    }
    (sum / PI.sqrt()).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::super::calibration::{assert_close, assert_uniform_p};
    use super::super::seed::{rng, uniform01};
    use super::*;

    /// A² from R's goftest; p of the limit law by mpmath, 40 digits.
    #[test]
    fn the_statistic_matches_a_reference() {
        let mut ten = [0.55, 0.13, 0.17, 0.97, 0.42, 0.01, 0.61, 0.78, 0.83, 0.31];
        let ad = anderson_darling(&mut ten).unwrap();
        assert_close(ad.a2, 0.24067883318678795, 1e-13);
        assert_close(ad.p, 0.9750996677678459, 1e-12);
        // R gives .9753, corrected for n = 10.
        assert!((ad.p - 0.9753).abs() < 0.042 / 10.0);
    }

    /// mpmath, 40 digits, by adaptive quadrature of Smirnov's formula.
    #[test]
    fn tails_are_true_tails() {
        for (a2, p) in [
            (0.1, 0.999971921895695),
            (0.5, 0.7468143735303445),
            (1.0, 0.3572666732140191),
            (2.492, 0.05002218635960787),
            (3.857, 0.01024115322986121),
            (6.0, 0.0009674519415209229),
            (10.0, 1.381503541068586e-5),
            (15.0, 7.633223180234202e-8),
            (20.0, 4.465071538311922e-10),
            (100.0, 3.628383098211147e-45),
        ] {
            assert_close(upper_p(a2), p, 1e-12);
        }
        assert_eq!((upper_p(0.0), upper_p(f64::INFINITY)), (1.0, 0.0));
    }

    /// Marsaglia and Marsaglia 2004: ADinf(2.5), which is 8e-6 off.
    #[test]
    fn the_bulk_agrees_with_the_published_approximation() {
        assert!((1.0 - upper_p(2.5) - 0.95046714497068).abs() < 1e-5);
    }

    /// From the nearest pole of the moment generating function: sqrt(3) erfc(sqrt z)(1 + 11/(36 z)).
    #[test]
    fn the_tail_agrees_with_its_asymptotic_form() {
        for z in [6.0, 10.0, 20.0, 50.0, 200.0, 600.0_f64] {
            let form = 3_f64.sqrt() * libm::erfc(z.sqrt()) * (1.0 + 11.0 / (36.0 * z));
            assert_close(upper_p(z), form, 0.11 / (z * z));
        }
    }

    #[test]
    fn p_falls_from_one() {
        let p: Vec<f64> = (0..2000).map(|i| upper_p(f64::from(i) * 0.005)).collect();
        assert!(p.windows(2).all(|w| w[1] <= w[0] + 1e-13));
    }

    #[test]
    fn p_is_uniform_on_an_ideal_source() {
        assert_uniform_p("stats.anderson_darling", |rng| {
            let mut values: Vec<f64> = (0..200).map(|_| uniform01(rng)).collect();
            anderson_darling(&mut values).unwrap().p
        });
    }

    /// One value in 70 is an exact zero: a distance of .014, which Kolmogorov-Smirnov cannot see in this
    /// sample.
    #[test]
    fn an_atom_at_zero_is_rejected() {
        let mut rng = rng("stats.anderson_darling.atom", 0);
        let mut values: Vec<f64> =
            (0..10_000).map(|i| if i % 70 == 0 { 0.0 } else { uniform01(&mut rng) }).collect();
        assert!(anderson_darling(&mut values).unwrap().p < 1e-9);
        assert!(ecdf::kolmogorov_smirnov(&mut values).unwrap().p > 1e-4);
    }

    #[test]
    fn what_is_not_in_the_interval_is_refused() {
        assert_eq!(anderson_darling(&mut []), Err(StatsError::Empty));
        assert!(anderson_darling(&mut [0.5, f64::NAN]).is_err());
    }
}
