//! Two scales from a derivative cut to whole object units per pixel (§5.4.2, the step before the logarithm).
//!
//! The paper keeps it to show two faults, and so do we: below one object unit per pixel the floor is 0 and the scale
//! infinite, and the interpolated value is not uniform.

use super::scales::{TwoScale, cell_at, longest_derivative};
use crate::threshold::footprint::Footprint;
use crate::threshold::real::Real;

/// Finds the cells at the floor and at the ceiling of the longest derivative. §5.4.2.
///
/// The floor has the smaller derivative and so the finer cells. Where the derivative is below 1 the scale of the
/// first cell is infinite and its index infinite or NaN, as in the paper.
#[must_use]
pub fn two_scale<R: Real>(footprint: &Footprint<R>, hash_scale: R) -> TwoScale<R> {
    let one = R::from_f64(1.0);
    let max_derivative = longest_derivative(footprint);
    let (floor, ceil) = (max_derivative.floor(), max_derivative.ceil());
    let cell_at = |derivative: R| {
        cell_at(footprint.position, [one / (hash_scale * derivative); 3], [derivative.to_i32(); 3])
    };
    TwoScale {
        max_derivative: [max_derivative; 3],
        pixel_scale: [one / (hash_scale * max_derivative); 3],
        octave: [floor.to_i32(); 3],
        floor_cell: cell_at(floor),
        ceil_cell: cell_at(ceil),
        lerp_factor: max_derivative.fract(),
    }
}
