//! Footprints in given cells, at given scales.

use crate::check::Subject;
use crate::check::tolerance::SPREAD;
use crate::scene::Fragment;
use crate::stats::seed;
use crate::threshold::footprint::Footprint;
use crate::threshold::two_scale::Variant;
use glam::{DVec2, DVec3, dvec3};
use rand::rngs::Xoshiro256PlusPlus;

/// Octaves out of which one is drawn where a claim is about the cells of one: from cells of 1024 units to cells of a
/// thousandth.
const DRAWN_OCTAVES: core::ops::Range<i32> = -10..11;

/// Pixels along each side of the screen on which single cells are seen.
const SCREEN: f64 = 1024.0;

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

/// The footprint in a cell of octave `octave` where that octave has all weight.
pub(crate) fn in_cell(subject: &Subject<'_>, cell: DVec3, octave: i32) -> Footprint<f64> {
    between(subject, cell, octave, 0.0)
}

/// The footprint in a cell of octave `octave`, at a scale that is `fraction` octaves finer along every axis.
pub(crate) fn between(subject: &Subject<'_>, cell: DVec3, octave: i32, fraction: f64) -> Footprint<f64> {
    let side = libm::exp2(f64::from(-octave));
    let position = (cell + 0.25) * side;
    let scale = [f64::from(octave) + fraction; 3];
    subject.precision.round(&at_scale(subject.variant, subject.hash_scale, position, scale))
}

/// Draws an octave out of [`DRAWN_OCTAVES`].
pub(crate) fn draw_octave(rng: &mut Xoshiro256PlusPlus) -> i32 {
    let count = f64::from(DRAWN_OCTAVES.end - DRAWN_OCTAVES.start);
    DRAWN_OCTAVES.start + (seed::uniform01(rng) * count) as i32
}

/// Draws a cell within [`SPREAD`] of the origin along every axis.
pub(crate) fn draw_cell(rng: &mut Xoshiro256PlusPlus) -> DVec3 {
    let mut index = || ((2.0 * seed::uniform01(rng) - 1.0) * SPREAD).floor();
    dvec3(index(), index(), index())
}

/// The same as a fragment: every cell of a layer in a pixel of its own.
pub(crate) fn seen_in_cell(subject: &Subject<'_>, cell: DVec3, octave: i32) -> Fragment {
    let footprint = in_cell(subject, cell, octave);
    let pixel = cell.truncate().rem_euclid(DVec2::splat(SCREEN)) + 0.5;
    Fragment {
        world: footprint.position,
        eye: footprint.position,
        pixel,
        texcoord: pixel / SCREEN,
        ..Fragment::from(footprint)
    }
}
