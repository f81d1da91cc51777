//! Does an image repeat itself as predicted? Its autocovariance at circular lags.
//!
//! A circular lag counts the pixels that leave the image on one side as if they came in on the other: every lag has as many
//! pairs as there are pixels, and the average of their products is a sum of ordinates of the
//! [periodogram](super::spectrum::periodogram) with the weights of a cosine. That gives it a law: the ordinates are nearly
//! independent exponential values ([`gamma_sum`](super::gamma_sum)).

use std::f64::consts::TAU;

/// What one ordinate of a periodogram adds to the autocovariance at a lag, together with the ordinate that mirrors it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// Index of the ordinate.
    pub index: usize,
    /// What an ordinate without a mirror image would be multiplied by; with one it is half of that each.
    pub weight: f64,
    /// Shape of the gamma law that the ordinate follows, in units of `weight` times its expectation: 1, or 1/2 where it
    /// is its own mirror image.
    pub shape: f64,
}

/// Gives the parts of the autocovariance at a circular lag: it is the sum of `shape * weight * periodogram[index]`.
///
/// The squared sum enters, as it does with the mean that is subtracted beforehand. Layout as in
/// [`periodogram`](super::spectrum::periodogram).
///
/// # Panics
/// If a side of `size` is 0.
#[must_use]
pub fn parts([width, height]: [usize; 2], lag: [i64; 2]) -> Vec<Part> {
    assert!(width > 0 && height > 0, "an image without pixels");
    let mut parts = Vec::with_capacity(width * height / 2 + 2);
    for index in 0..width * height {
        let [kx, ky] = [index % width, index / width];
        let mirror = (height - ky) % height * width + (width - kx) % width;
        if mirror < index {
            continue;
        }
        // Whole turns are taken off before they cost digits.
        let turns = |k: usize, lag: i64, n: usize| (k as i64 * lag).rem_euclid(n as i64) as f64 / n as f64;
        let angle = TAU * (turns(kx, lag[0], width) + turns(ky, lag[1], height));
        let weight = 2.0 * libm::cos(angle) / (width * height) as f64;
        parts.push(Part { index, weight, shape: if mirror == index { 0.5 } else { 1.0 } });
    }
    parts
}
