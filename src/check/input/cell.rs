//! Footprints in given cells, at given scales.

use crate::check::tolerance::SPREAD;
use crate::stats::seed;
use crate::threshold::footprint::Footprint;
use crate::threshold::two_scale::Variant;
use glam::{DVec3, dvec3};
use rand::rngs::Xoshiro256PlusPlus;

/// What a scale is divided by: Listing 2 counts the diagonal of a cell.
pub(crate) fn numerator(variant: Variant) -> f64 {
    if variant == Variant::Anisotropic { 0.707 } else { 1.0 }
}

/// A footprint with given logarithms to base two of the cells per object unit; the first counts where a variant has
/// only one scale.
pub(crate) fn at_scale(
    variant: Variant,
    hash_scale: f64,
    position: DVec3,
    log_scale: [f64; 3],
) -> Footprint<f64> {
    let derivative = log_scale.map(|log| numerator(variant) * libm::exp2(-log) / hash_scale);
    let dpdx = if variant == Variant::Anisotropic {
        DVec3::from_array(derivative)
    } else {
        dvec3(derivative[0], 0.0, 0.0)
    };
    Footprint { position, dpdx, dpdy: dpdx * 0.5 }
}

/// Draws a cell within [`SPREAD`] of the origin along every axis.
pub(crate) fn draw_cell(rng: &mut Xoshiro256PlusPlus) -> DVec3 {
    let mut index = || ((2.0 * seed::uniform01(rng) - 1.0) * SPREAD).floor();
    dvec3(index(), index(), index())
}
