//! Several measured shares, each beside the one that is predicted.

use crate::check::evidence::ComparedShare;
use crate::check::tolerance::{POWER, SINGLE_LEVEL};
use crate::stats::power;

/// The error in any of the shares that would be seen wherever it were: by the least certain of the trials, at its part
/// of the level.
pub(crate) fn detectable_error(points: &[ComparedShare]) -> Option<f64> {
    let sigma = points.iter().map(|point| point.sigma).reduce(f64::max)?;
    Some(power::detectable_shift_z(sigma, SINGLE_LEVEL / points.len() as f64, POWER))
}
