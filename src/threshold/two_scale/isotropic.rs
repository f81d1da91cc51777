//! Listing 1: one scale for all axes, between two octaves.

use super::scales::{TwoScale, cell_at, longest_derivative};
use crate::threshold::footprint::Footprint;
use crate::threshold::real::Real;

/// Finds the cells at the two powers of two around the scale. Listing 1, up to `lerpFactor`.
///
/// Literal: a derivative or a `hash_scale` that is zero, negative, infinite or NaN, or whose square under- or
/// overflows, gives cells and a weight that are infinite or NaN.
#[must_use]
pub fn two_scale<R: Real>(footprint: &Footprint<R>, hash_scale: R) -> TwoScale<R> {
    let max_derivative = longest_derivative(footprint);
    let pixel_scale = R::from_f64(1.0) / (hash_scale * max_derivative);
    let log_scale = pixel_scale.log2();
    let (floor, ceil) = (log_scale.floor(), log_scale.ceil());
    let cell_at = |octave: R| cell_at(footprint.position, [octave.exp2(); 3], [octave.to_i32(); 3]);
    TwoScale {
        max_derivative: [max_derivative; 3],
        pixel_scale: [pixel_scale; 3],
        octave: [floor.to_i32(); 3],
        floor_cell: cell_at(floor),
        ceil_cell: cell_at(ceil),
        lerp_factor: log_scale.fract(),
    }
}
