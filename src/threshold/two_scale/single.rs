//! One scale, one hash (§5.4.1): stable under translation along the screen, redrawn with every change of distance.

use super::scales::{TwoScale, cell_at, longest_derivative};
use crate::threshold::footprint::Footprint;
use crate::threshold::real::Real;

/// Finds the cell at the scale itself; both cells are that one and `lerp_factor` is 0. §5.4.1.
#[must_use]
pub fn two_scale<R: Real>(footprint: &Footprint<R>, hash_scale: R) -> TwoScale<R> {
    let pixel_derivative = longest_derivative(footprint);
    let pixel_scale = R::from_f64(1.0) / (hash_scale * pixel_derivative);
    let only_cell = cell_at(footprint.position, [pixel_scale; 3], [0; 3]);
    TwoScale {
        max_derivative: [pixel_derivative; 3],
        pixel_scale: [pixel_scale; 3],
        octave: [0; 3],
        floor_cell: only_cell,
        ceil_cell: only_cell,
        lerp_factor: R::from_f64(0.0),
    }
}
