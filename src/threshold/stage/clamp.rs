//! The last step of every pipeline.

use crate::threshold::real::Real;
use crate::threshold::robust::SMALLEST_ROBUST_THRESHOLD;

/// Brings a threshold into [2^-24, 1]: the last step after any of the transformations of §7 and §8, so that alpha 0
/// never passes and alpha 1 always does. NaN stays NaN. Not in the paper, which clamps before them.
#[must_use]
pub fn clamp_last<R: Real>(threshold: R) -> R {
    Real::clamp(threshold, R::from_f64(SMALLEST_ROBUST_THRESHOLD), R::from_f64(1.0))
}
