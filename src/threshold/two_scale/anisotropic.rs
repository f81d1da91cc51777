//! Listing 2: one scale an axis, each between two octaves.

use super::scales::{TwoScale, cell_at};
use crate::threshold::footprint::Footprint;
use crate::threshold::real::Real;
use crate::threshold::real::length_of;

/// Finds the two opposite corners of the box of octaves around the three scales. Listing 2, up to `lerpFactor`.
///
/// Where the listing reads `anisoScale` it means the `anisoScales` that it declares. Literal otherwise: an axis along
/// which neither derivative moves has an infinite scale, and the weight is then NaN.
#[must_use]
pub fn two_scale<R: Real>(footprint: &Footprint<R>, hash_scale: R) -> TwoScale<R> {
    let (dx, dy): ([R; 3], [R; 3]) = (footprint.dpdx.into(), footprint.dpdy.into());
    let max_derivative = [0, 1, 2].map(|axis| Real::max(dx[axis].abs(), dy[axis].abs()));
    let pixel_scale = max_derivative.map(|derivative| R::from_f64(0.707) / (hash_scale * derivative));
    let log_scale = pixel_scale.map(R::log2);
    let cell_at = |octave: [R; 3]| cell_at(footprint.position, octave.map(R::exp2), octave.map(R::to_i32));
    let fraction = log_scale.map(R::fract);
    let to_floor = length_of(fraction);
    let to_ceil = length_of(fraction.map(|f| R::from_f64(1.0) - f));
    TwoScale {
        max_derivative,
        pixel_scale,
        octave: log_scale.map(|l| l.floor().to_i32()),
        floor_cell: cell_at(log_scale.map(R::floor)),
        ceil_cell: cell_at(log_scale.map(R::ceil)),
        lerp_factor: to_floor / (to_floor + to_ceil),
    }
}
