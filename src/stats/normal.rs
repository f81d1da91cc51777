//! Tails and quantile of the standard normal law.

use statrs::distribution::{ContinuousCDF, Normal};
use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

/// Gives the probability that a normal score is at least `|z|` away from 0, on either side.
///
/// In `[0, 1]`; a true tail, exact to a relative error below 1e-13 down to 1e-300 (|z| = 37); NaN for NaN.
#[must_use]
pub fn two_sided_p(z: f64) -> f64 {
    libm::erfc(z.abs() * FRAC_1_SQRT_2)
}

/// Gives the probability that a normal score is at least `z`.
///
/// In `[0, 1]`; a true tail for positive `z`. The lower tail is `upper_p(-z)`.
#[must_use]
pub fn upper_p(z: f64) -> f64 {
    0.5 * libm::erfc(z / SQRT_2)
}

/// Gives the score below which a normal score falls with probability `p`.
///
/// `p` is in `[0, 1]`; the ends give the infinities. Accurate for `p` down to 1e-300, so the score that is
/// exceeded with a tiny probability `p` is `-quantile(p)`, not `quantile(1 - p)`.
///
/// # Panics
/// If `p` is NaN or not in `[0, 1]`.
#[must_use]
pub fn quantile(p: f64) -> f64 {
    assert!((0.0..=1.0).contains(&p), "{p} is not a probability");
    Normal::standard().inverse_cdf(p)
}

#[cfg(test)]
mod tests {
    use super::super::calibration::{assert_close, assert_uniform_p};
    use super::super::seed::uniform01;
    use super::*;

    /// mpmath, 50 digits.
    #[test]
    fn tails_are_true_tails() {
        for (z, p) in [
            (1.0, 0.317310507862914103),
            (3.0, 0.00269979606326018905),
            (6.0, 1.97317529007539628e-9),
            (9.0, 2.2571768119076813e-19),
            (20.0, 5.50724823721246739e-89),
            (37.0, 1.14511424450491536e-299),
        ] {
            assert_close(two_sided_p(z), p, 1e-13);
            assert_close(two_sided_p(-z), p, 1e-13);
            assert_close(upper_p(z), p / 2.0, 1e-13);
            assert_close(upper_p(-z), 1.0 - p / 2.0, 1e-15);
        }
    }

    /// mpmath, 50 digits.
    #[test]
    fn quantiles_reach_deep() {
        assert_eq!(quantile(0.5), 0.0);
        for (p, z) in [
            (0.3, -0.524400512708040784),
            (0.999, 3.09023230616781354),
            (1e-9, -5.99780701500768687),
            (1e-100, -21.2734535609653243),
            (1e-300, -37.0470962993611992),
        ] {
            assert_close(quantile(p), z, 1e-14);
        }
        assert_eq!((quantile(0.0), quantile(1.0)), (f64::NEG_INFINITY, f64::INFINITY));
    }

    /// The sum of 64 uniforms: mean 32, variance 64/12, close enough to normal for a thousand replicas.
    #[test]
    fn p_is_uniform_on_an_ideal_source() {
        let score =
            |rng: &mut _| ((0..64).map(|_| uniform01(rng)).sum::<f64>() - 32.0) / (64.0_f64 / 12.0).sqrt();
        assert_uniform_p("stats.normal.two_sided_p", |rng| two_sided_p(score(rng)));
        assert_uniform_p("stats.normal.upper_p", |rng| upper_p(score(rng)));
    }

    #[test]
    fn a_shifted_mean_is_rejected() {
        assert!(two_sided_p((0.51 - 0.5) * (12.0 * 1e6_f64).sqrt()) < 1e-200);
    }
}
