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
