//! What all variants make, and what they make it of.

use crate::threshold::footprint::Footprint;
use crate::threshold::hash::{Cell, octave_word};
use crate::threshold::real::{Real, length_of};

/// The two cells of a footprint and the weight between them.
///
/// Quantities that the variant has once hold the same value for all three axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoScale<R: Real> {
    /// Object units per pixel: `maxDeriv` (Listing 1), `anisoDeriv` (Listing 2), `pixDeriv` (§5.4.1).
    pub max_derivative: [R; 3],
    /// Cells per object unit before discretisation: `pixScale` (Listing 1), `anisoScales` (Listing 2).
    pub pixel_scale: [R; 3],
    /// The floor of the quantity that is discretised: of log2 `pixel_scale` in both listings, of `max_derivative` in
    /// [`linear`](mod@super::linear); 0 in [`single`](mod@super::single). Saturates.
    pub octave: [i32; 3],
    /// The cell at the floor of that quantity (hashed into the paper's `alpha.x`): the coarse cell of both listings,
    /// the fine cell of [`linear`](mod@super::linear).
    pub floor_cell: Cell<R>,
    /// The cell at its ceiling (hashed into `alpha.y`).
    pub ceil_cell: Cell<R>,
    /// Weight of the second cell, in [0, 1] (`lerpFactor`).
    pub lerp_factor: R,
}

/// Returns the larger length of the two derivatives: `max(length_of(dFdx(objCoord.xyz)), length_of(dFdy(objCoord.xyz)))`.
pub(crate) fn longest_derivative<R: Real>(footprint: &Footprint<R>) -> R {
    Real::max(length_of(footprint.dpdx.into()), length_of(footprint.dpdy.into()))
}

/// Returns the cell of `position` in a grid with `scale` cells per object unit.
pub(crate) fn cell_at<R: Real>(position: R::Vec3, scale: [R; 3], octave: [i32; 3]) -> Cell<R> {
    let ([x, y, z], [sx, sy, sz]) = (position.into(), scale);
    let index = [(sx * x).floor(), (sy * y).floor(), (sz * z).floor()];
    Cell { index: index.into(), octave: octave_word(octave) }
}
