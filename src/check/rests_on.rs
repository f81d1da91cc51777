//! What a known failure of the listings rests on, and whether that is true of another subject.
//!
//! A reason that names a hash or a division says nothing about a subject that has neither. Each is tried on the subject
//! itself, where the other claims do not look.

use super::input::{at_scale, draw_cell, general_scenes, placed, placement, sighting, tangents, zoomed};
use super::judge::histogram;
use super::predict::{largest_change, log_scale};
use super::subject::Subject;
use super::tolerance::SINGLE_LEVEL;
use crate::scene::{Fragment, Scene};
use crate::stats::{chi_square, seed};
use crate::threshold::footprint::Footprint;
use crate::threshold::hashed::HashedAlpha;
use glam::{DVec3, dvec3};
use rand::rngs::Xoshiro256PlusPlus;

/// Columns of cells among which two of one threshold are sought: 2,000 pairs for the `f32` sine hash, half a pair for four
/// million values.
const COLUMNS: usize = 1 << 12;

/// Fewest of those pairs: a tenth of what the `f32` sine hash has.
const LEAST_PAIRS: usize = 200;

/// Share of those pairs that are one in other layers, too: half, since the second hash brings other pairs together, too.
const SAME_COLUMN: f64 = 0.3;

/// Cells from the origin at which thresholds are still uniform, along all axes: the third of the windows of `cells.window`.
const NEAR: f64 = 65_536.0;

/// Share of points at which a reason has to be seen: devices round some of them into another cell.
const MOST: f64 = 0.9;

/// Share of points at which it may fail elsewhere, for the same cause.
const FEW: f64 = 1.0e-3;

/// Points at which a reason is tried.
const POINTS: usize = 1 << 12;

/// Decimal orders of the distance from the origin at which thresholds are asked for: one to 10^4 units.
const ORDERS: f64 = 4.0;

/// Octaves around one cell a unit over which they are asked for, to both sides.
const OCTAVES: f64 = 8.0;

/// Two thresholds that are nearer than this are one: a device's rounding of the weight, not another hash.
const SAME: f64 = 1.0e-3;

/// Octaves between two views of a point, as in `continuity.zoom`.
const STEP: f64 = 1.0 / 2048.0;

/// Points that are followed through an octave.
const FOLLOWED: usize = 16;

/// Cells around the origin along each axis, to both sides, that should have thresholds of their own.
const AROUND: i32 = 3;

/// Share of those cells that has to have: with some 4000 values one in twenty meets another, on devices one in ten.
const OWN: f64 = 0.75;

/// What makes the paper's listings fail a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum RestsOn {
    /// The hash of the paper in `f32`: x and y become one of few values before z comes in.
    SineHash,
    /// That hash where the sines have arguments in the millions; nearer, thresholds are uniform.
    SineFarAway,
    /// A division by a derivative of zero: NaN there, and nowhere else.
    DivisionByZero,
    /// Cells whose faces lie at whole numbers in every octave.
    FacesAtWholeNumbers,
    /// Cells of all axes exchanged where one axis passes an octave, and only there.
    OctaveExchange,
    /// A hash that does not read the octave: half the size, the same noise; and no copy beyond that.
    NoOctaveInHash,
    /// The cells around the origin, which are the same in every octave; only those eight.
    OriginCells,
}

impl RestsOn {
    /// The reason in a few words, as in "the sine hash".
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::SineHash => "x and y that are hashed into few values before z comes in",
            Self::SineFarAway => "sines of arguments in the millions, and not before",
            Self::DivisionByZero => "a division by a derivative of zero",
            Self::FacesAtWholeNumbers => "faces of cells at whole numbers",
            Self::OctaveExchange => "cells that are exchanged where one axis passes an octave",
            Self::NoOctaveInHash => "a hash that does not read the octave",
            Self::OriginCells => "eight cells around the origin that are the same in every octave",
        }
    }

    /// Returns whether that is true of a subject.
    #[must_use]
    pub fn is_true_of(self, subject: &Subject<'_>) -> bool {
        let rng = &mut seed::rng("known.rests_on", 0);
        match self {
            Self::SineHash => has_few_columns(subject, rng),
            Self::SineFarAway => has_few_columns(subject, rng) && is_uniform_nearer(subject, rng),
            Self::DivisionByZero => fails_only_with_the_listing(subject, rng),
            Self::FacesAtWholeNumbers => has_whole_faces(subject, rng),
            Self::OctaveExchange => is_smooth_within_octaves(subject, rng),
            Self::NoOctaveInHash => repeats_at_half_the_size(subject, rng),
            Self::OriginCells => repeats_at_the_origin_only(subject),
        }
    }
}

/// The footprint at a place within a cell, in cells, where one octave has all weight.
fn in_cell(subject: &Subject<'_>, place: DVec3, octave: i32) -> Footprint<f64> {
    let position = place * libm::exp2(f64::from(-octave));
    let scale = [f64::from(octave); 3];
    subject.precision.round(&at_scale(subject.variant, subject.hash_scale, position, scale))
}

fn is_threshold(value: f64) -> bool {
    value > 0.0 && value <= 1.0
}

/// The share of pairs of neighbouring values that a relation holds for.
fn share(values: &[f64], holds: impl Fn(f64, f64) -> bool) -> f64 {
    let pairs = values.chunks_exact(2);
    let n = pairs.len() as f64;
    pairs.filter(|pair| holds(pair[0], pair[1])).count() as f64 / n
}

/// Two columns with one threshold in a layer have one in other layers.
fn has_few_columns(subject: &Subject<'_>, rng: &mut Xoshiro256PlusPlus) -> bool {
    let cells: Vec<DVec3> = (0..COLUMNS).map(|_| draw_cell(rng)).collect();
    let layer = |z: f64, cells: &[DVec3]| {
        let places: Vec<_> = cells.iter().map(|cell| in_cell(subject, cell.with_z(z) + 0.25, 0)).collect();
        subject.thresholds(&places)
    };
    let mut found: Vec<(u64, DVec3)> =
        layer(7.0, &cells).into_iter().map(f64::to_bits).zip(cells.iter().copied()).collect();
    found.sort_by_key(|(bits, _)| *bits);
    let is_meeting = |pair: &&[(u64, DVec3)]| pair[0].0 == pair[1].0 && f64::from_bits(pair[0].0) > 1.0e-5;
    let pairs: Vec<DVec3> =
        found.windows(2).filter(is_meeting).flat_map(|pair| [pair[0].1, pair[1].1]).collect();
    pairs.len() >= 2 * LEAST_PAIRS
        && [-3.0, 12.0, 101.0].into_iter().all(|z| share(&layer(z, &pairs), |a, b| a == b) >= SAME_COLUMN)
}

/// Thresholds in a window of cells at a middle distance are uniform.
fn is_uniform_nearer(subject: &Subject<'_>, rng: &mut Xoshiro256PlusPlus) -> bool {
    let places: Vec<_> = (0..POINTS).map(|_| in_cell(subject, draw_cell(rng) + NEAR, 0)).collect();
    let counts = histogram(subject.thresholds(&places));
    chi_square::uniform(counts.counts()).is_ok_and(|test| test.p > SINGLE_LEVEL) && counts.outside == 0
}

/// No threshold fails where the listing has one: on surfaces of every kind, far and near, fine and coarse.
fn fails_only_with_the_listing(subject: &Subject<'_>, rng: &mut Xoshiro256PlusPlus) -> bool {
    let scenes = Scene::all();
    let mut points: Vec<Fragment> = Vec::new();
    for index in 0..POINTS {
        let place = placement(rng);
        let found = sighting(&scenes[index % scenes.len()], rng);
        points.push(found.placed(place, subject.precision).fragment);
        let far = place * libm::exp10(ORDERS * seed::uniform01(rng) - 1.0);
        let octaves = (2.0 * seed::uniform01(rng) - 1.0) * OCTAVES;
        let [dpdx, dpdy] = zoomed(tangents(rng), octaves);
        points.push(subject.precision.round(&Footprint { position: far, dpdx, dpdy }).into());
    }
    let listing = HashedAlpha { hash_scale: subject.hash_scale, ..HashedAlpha::listing(subject.variant) };
    let listing = Subject::hashed("listing", subject.precision, listing);
    let values = listing.thresholds(&points).into_iter().zip(subject.thresholds(&points));
    let (mut of_the_listing, mut others) = (0_usize, 0_usize);
    for (listing, value) in values {
        of_the_listing += usize::from(is_threshold(listing));
        others += usize::from(is_threshold(listing) && !is_threshold(value));
    }
    others as f64 <= FEW * of_the_listing as f64
}

/// Thresholds stay between whole numbers and change at them.
fn has_whole_faces(subject: &Subject<'_>, rng: &mut Xoshiro256PlusPlus) -> bool {
    let (mut within, mut across) = (Vec::new(), Vec::new());
    for index in 0..POINTS {
        let (cell, axis) = (draw_cell(rng), DVec3::AXES[index % 3]);
        let at = |part: f64| in_cell(subject, cell + (DVec3::ONE - axis) * 0.4 + axis * part, 0);
        within.extend([at(0.02), at(0.98)]);
        across.extend([at(0.98), at(1.02)]);
    }
    share(&subject.thresholds(&within), |a, b| a == b) >= MOST
        && share(&subject.thresholds(&across), |a, b| a != b) >= MOST
}

/// While no axis passes an octave, the threshold moves no further than its join allows.
fn is_smooth_within_octaves(subject: &Subject<'_>, rng: &mut Xoshiro256PlusPlus) -> bool {
    let (mut steps, mut jumps) = (0_u32, 0_u32);
    for _ in 0..FOLLOWED {
        let (position, tangents) = (placement(rng), tangents(rng));
        let view = |step: i32| {
            let [dpdx, dpdy] = zoomed(tangents, STEP * f64::from(step));
            subject.precision.round(&Footprint { position, dpdx, dpdy })
        };
        let views: Vec<Footprint<f64>> = (0..(1.0 / STEP) as i32).map(view).collect();
        let thresholds = subject.thresholds(&views);
        for (views, values) in views.windows(2).zip(thresholds.windows(2)) {
            let [before, after] = [0, 1].map(|at| subject.nominal(&views[at]));
            let is_near = |scale: f64| (scale - scale.round()).abs() < 2.0 * STEP;
            if log_scale(&before).into_iter().any(is_near) {
                continue;
            }
            steps += 1;
            // Of two numbers one of which is none, neither is the larger.
            let is_small = (values[1] - values[0]).abs() <= largest_change(subject, &before, &after) + SAME;
            jumps += u32::from(!is_small);
        }
    }
    f64::from(jumps) <= FEW * f64::from(steps)
}

/// An object of half the size has the same thresholds; two octaves down, at the same place, there are others.
fn repeats_at_half_the_size(subject: &Subject<'_>, rng: &mut Xoshiro256PlusPlus) -> bool {
    let scenes = general_scenes();
    let (mut halves, mut descendants) = (Vec::new(), Vec::new());
    for index in 0..POINTS {
        let found = sighting(&scenes[index % scenes.len()], rng).fragment;
        let whole = placed(&found, placement(rng), subject.precision).footprint;
        let half = |v: DVec3| 0.5 * v;
        let smaller =
            Footprint { position: half(whole.position), dpdx: half(whole.dpdx), dpdy: half(whole.dpdy) };
        halves.extend([whole, smaller]);
        let cell = draw_cell(rng);
        descendants.extend([in_cell(subject, cell + 0.25, 0), in_cell(subject, 4.0 * cell + 0.25, 2)]);
    }
    let same = |a: f64, b: f64| (a - b).abs() < SAME;
    share(&subject.thresholds(&halves), same) >= MOST
        && share(&subject.thresholds(&descendants), same) <= 1.0 - MOST
}

/// Each octant has one threshold in every octave, and the cells next to the eight have thresholds of their own.
fn repeats_at_the_origin_only(subject: &Subject<'_>) -> bool {
    let octants = (0..8_u32)
        .map(|octant| DVec3::from_array([1, 2, 4].map(|bit| if octant & bit == 0 { 0.3 } else { -0.7 })));
    let pairs: Vec<Footprint<f64>> = octants
        .flat_map(|place| {
            let octaves = -(OCTAVES as i32)..OCTAVES as i32;
            octaves.flat_map(move |octave| [in_cell(subject, place, octave), in_cell(subject, place, 0)])
        })
        .collect();
    let range = || (-AROUND..AROUND).map(f64::from);
    let around: Vec<Footprint<f64>> = range()
        .flat_map(|x| range().flat_map(move |y| range().map(move |z| dvec3(x, y, z) + 0.25)))
        .map(|place| in_cell(subject, place, 0))
        .collect();
    let mut values = subject.thresholds(&around);
    values.sort_unstable_by(f64::total_cmp);
    let all = values.len() as f64;
    values.dedup();
    share(&subject.thresholds(&pairs), |a, b| (a - b).abs() < SAME) >= MOST
        && values.len() as f64 >= OWN * all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::subject::Precision;
    use crate::threshold::robust::Robust;
    use crate::threshold::two_scale::Variant;

    const ALL: [RestsOn; 7] = [
        RestsOn::SineHash,
        RestsOn::SineFarAway,
        RestsOn::DivisionByZero,
        RestsOn::FacesAtWholeNumbers,
        RestsOn::OctaveExchange,
        RestsOn::NoOctaveInHash,
        RestsOn::OriginCells,
    ];

    #[test]
    fn every_reason_is_true_of_the_listings() {
        for subject in Subject::paper() {
            for reason in ALL {
                // In f64 the sine hash has all the values that it needs.
                let is_of_f32 = matches!(reason, RestsOn::SineHash | RestsOn::SineFarAway);
                let expected = !is_of_f32 || subject.precision == Precision::F32;
                assert_eq!(reason.is_true_of(&subject), expected, "{subject:?}: {reason:?}");
            }
        }
    }

    #[test]
    fn those_of_the_hash_and_the_cells_are_not_true_of_the_robust_threshold() {
        let robust = Subject::robust("robust", Precision::F32, Robust::new(Variant::Isotropic));
        let found = ALL.map(|reason| reason.is_true_of(&robust));
        assert_eq!(found, [false, false, true, false, true, false, false]);
    }
}
