//! Where cells begin and how large they are.

use super::probe::{ALONE, Probe, SAME};
use super::slip::{Found, Slip, found, named};
use crate::stats::seed;
use crate::threshold::two_scale::Variant;
use glam::{DVec3, dvec3};
use rand::rngs::Xoshiro256PlusPlus;

/// Rows along which faces are looked for.
const ROWS: usize = 96;

/// Places a cell at which a row is asked: a twelfth apart, beginning a twenty-fourth from the whole number, so that faces at
/// thirds and halves lie between two of them.
const PLACES: usize = 12;

/// Cells a row.
const LENGTH: usize = 4;

/// A share of rows with a face at a place where all have one: the hashes of some neighbours are the same by chance.
const MOST: f64 = 0.95;

/// A share of rows with a face where there is none.
const FEW: f64 = 0.02;

/// Octaves by which cells may be finer than they should be, in the order in which they are tried.
const SIZES: [i32; 12] = [0, 1, -1, 2, -2, 3, -3, 4, -4, 5, FINEST, -5];

/// The most of them.
const FINEST: i32 = 6;

/// A change within a cell that is no redraw.
const SMOOTH: f64 = 0.2;

/// Told also where the hash is its own mirror image.
pub(super) const TRUNCATION: Slip = named("truncation");
const NEAREST: Slip = named("nearest-cell");
const NO_FLOOR: Slip = named("no-floor");
const SMOOTH_NOISE: Slip = named("smooth-noise");
const PHASE: Slip = named("other-phase");

/// What the faces of cells are.
#[derive(Default)]
pub(super) struct Faces {
    pub found: Option<Found>,
    /// Whether a point has no cell: every move changes its threshold.
    pub none: bool,
    /// Octaves by which cells are finer than they should be.
    pub finer: i32,
    /// Whether some cells have a face in their middle and others have none, as a function of two cells has.
    pub of_two: bool,
}

/// Whether the hash of the finer octave changes within its cells, where that of the coarser one does not. The other way around the coarser
/// cell, which is looked at first, has no faces.
pub(super) fn uncut(probe: &Probe<'_>, rng: &mut Xoshiro256PlusPlus) -> Option<Found> {
    const FINER: Slip = named("finer-cells-uncut");
    const PAIRS: usize = 192;
    /// Two places of one cell, in a half of it, and how many of them have one threshold.
    const CUT: f64 = 0.9;
    const UNCUT: f64 = 0.1;
    let mut index = || (seed::uniform01(rng) * 100.0).floor() + 0.3;
    let pairs: Vec<_> = (0..PAIRS)
        .map(|_| [(); 3].map(|()| index()))
        .map(DVec3::from_array)
        .map(|at| [at, at + 0.1])
        .collect();
    let [coarser, finer] = [ALONE, 1.0 - ALONE].map(|lean| Probe { lean, ..*probe }.share(&pairs));
    let shown = format!(
        "of {PAIRS} pairs of places in one cell {:.0} % have one threshold at the coarser scale and {:.0} % at the finer one",
        100.0 * coarser,
        100.0 * finer
    );
    (coarser > CUT && finer < UNCUT).then(|| found(FINER, shown))
}

fn index(rng: &mut Xoshiro256PlusPlus) -> f64 {
    (seed::uniform01(rng) * 30.0).floor() + 3.0
}

/// The share of cells of an octave that have a face in each twelfth, and the share of small changes among all.
fn faces(probe: &Probe<'_>, octave: i32, rng: &mut Xoshiro256PlusPlus) -> ([f64; PLACES], f64) {
    let mut places = Vec::new();
    for row in 0..ROWS {
        let start = dvec3(index(rng), index(rng), index(rng)) * 4.0 + 0.45;
        let axis = DVec3::AXES[row % 3];
        let start = start - axis * (0.45 - 0.5 / PLACES as f64);
        places.extend((0..=LENGTH * PLACES).map(|step| start + axis * (step as f64 / PLACES as f64)));
    }
    let values = probe.cells_at(octave, &places);
    let mut shares = [0.0; PLACES];
    let (mut changes, mut small) = (0.0, 0.0);
    for row in values.chunks_exact(LENGTH * PLACES + 1) {
        for (step, pair) in row.windows(2).enumerate() {
            if (pair[1] - pair[0]).abs() >= SAME {
                shares[(step + 1) % PLACES] += 1.0 / (ROWS * LENGTH) as f64;
                changes += 1.0;
                small += f64::from((pair[1] - pair[0]).abs() < SMOOTH);
            }
        }
    }
    (shares, if changes > 0.0 { small / changes } else { 0.0 })
}

/// Looks where cells begin.
pub(super) fn look(probe: &Probe<'_>, declared_phase: bool, rng: &mut Xoshiro256PlusPlus) -> Faces {
    if let Some(exchanged) = exchanged(probe, rng) {
        return Faces { found: Some(exchanged), ..Faces::default() };
    }
    let (shares, small) = faces(probe, 0, rng);
    let changing =
        |shares: &[f64; PLACES], least: f64| shares.iter().filter(|&&share| share >= least).count();
    let without = |slip: Slip, shown: &str| Faces {
        found: Some(found(slip, shown.to_owned())),
        none: true,
        ..Faces::default()
    };
    // Where noise is smooth some of its changes are too small to be seen, and next to a corner most are.
    if changing(&shares, 0.7) >= PLACES - 2 && small > 0.7 {
        return without(
            SMOOTH_NOISE,
            "within a cell the threshold changes smoothly, at every twelfth of its side",
        );
    }
    for finer in SIZES {
        let resized = Probe { finer, ..*probe };
        let [even, odd] = [0, -1].map(|octave| only_face(&faces(&resized, octave, rng).0));
        if let (Some(even), Some(odd)) = (even, odd) {
            let found =
                sliding(&resized, rng).or_else(|| one_face(&resized, declared_phase, [even, odd], rng));
            return Faces { found, finer, ..Faces::default() };
        }
    }
    let finest = Probe { finer: FINEST, ..*probe };
    if changing(&faces(&finest, 0, rng).0, MOST) == PLACES {
        return without(NO_FLOOR, "the threshold is another one at every twelfth of the smallest cell");
    }
    let half = PLACES / 2;
    let places: Vec<usize> = (0..PLACES).filter(|&place| shares[place] > FEW).collect();
    let of_two = matches!(places[..], [a, b] if b == a + half && (shares[a] < MOST) != (shares[b] < MOST)
        && shares[a].min(shares[b]) > 0.2);
    Faces { of_two, ..Faces::default() }
}

/// The twelfth in which all cells have their only face.
fn only_face(shares: &[f64; PLACES]) -> Option<usize> {
    let mut places = (0..PLACES).filter(|&place| shares[place] > FEW);
    places.next().filter(|&place| shares[place] >= MOST && places.next().is_none())
}

/// What is wrong with cells that have one face each, at a twelfth of an even and of an odd octave.
fn one_face(
    probe: &Probe<'_>,
    declared_phase: bool,
    faces: [usize; 2],
    rng: &mut Xoshiro256PlusPlus,
) -> Option<Found> {
    const WHOLE: Slip = named("cells-at-whole-numbers");
    const THIRD: usize = PLACES / 3;
    const HALF: usize = PLACES / 2;
    let is_nested = matches!(faces, [THIRD, other] | [other, THIRD] if other == 2 * THIRD);
    if faces == [HALF; 2] {
        let wide = 100.0 * across_zero(probe, 0.2, [0.2, -1.2], rng);
        let shown =
            format!("cells begin at halves, and {wide:.0} % of {ROWS} cells at zero are twice as wide");
        return Some(found(NEAREST, shown));
    }
    if !is_nested && faces != [0; 2] {
        return None;
    }
    let zero = across_zero(probe, 0.45, [0.45, -0.45], rng);
    if zero >= MOST {
        let zero = 100.0 * zero;
        let shown = format!("of {ROWS} pairs of cells at both sides of zero {zero:.0} % have one threshold");
        return Some(found(TRUNCATION, shown));
    }
    match (is_nested, declared_phase) {
        (true, false) => Some(found(PHASE, "cells begin at thirds of a cell".to_owned())),
        (false, true) => Some(found(WHOLE, "cells begin at whole numbers, in every octave".to_owned())),
        (true, true) | (false, false) => None,
    }
}

/// Whether cells have the very size of the scale: halfway between two octaves faces lie where neither octave has one.
fn sliding(probe: &Probe<'_>, rng: &mut Xoshiro256PlusPlus) -> Option<Found> {
    const SLIDING: Slip = named("no-octaves");
    let between = Probe { lean: 0.5, ..*probe };
    let (shares, _) = faces(&between, 0, rng);
    let widest = shares.iter().copied().fold(0.0, f64::max);
    let everywhere = shares.iter().all(|&share| share > 2.0 * FEW);
    (everywhere && widest < 0.5).then(|| {
        let shown = "halfway between two octaves cells begin at any twelfth of those of either octave";
        found(SLIDING, shown.to_owned())
    })
}

/// How often the threshold changes along rows of given length, in a view with given octaves; none where there is no such view.
fn changes(probe: &Probe<'_>, axis: DVec3, octave: DVec3, rng: &mut Xoshiro256PlusPlus) -> Option<usize> {
    const STEPS: usize = 128;
    const LONG: f64 = 4.0;
    let mut positions = Vec::new();
    for _ in 0..16 {
        let start = dvec3(index(rng), index(rng), index(rng)) + 0.003;
        positions.extend((0..STEPS).map(|step| start + axis * (LONG * step as f64 / STEPS as f64)));
    }
    let values = probe.seen(octave, &positions);
    let of_row = |row: &[f64]| row.windows(2).filter(|pair| (pair[1] - pair[0]).abs() >= SAME).count();
    (!values.iter().any(|value| value.is_nan())).then(|| values.chunks_exact(STEPS).map(of_row).sum())
}

/// Whether cells become larger where they should become smaller, or those of one axis where those of another should.
pub(super) fn inverse(probe: &Probe<'_>, rng: &mut Xoshiro256PlusPlus) -> Option<Found> {
    const INVERSE: Slip = named("inverse-scale");
    let [coarse, fine] = [0.0, 3.0].map(|octave| changes(probe, DVec3::X, DVec3::splat(octave), rng));
    let (coarse, fine) = (coarse?, fine?);
    (coarse > 0 && 2 * fine < coarse).then(|| {
        found(
            INVERSE,
            format!(
                "along a row {coarse} thresholds change, and {fine} where derivatives are an eighth as long"
            ),
        )
    })
}

/// Whether the scales of two axes are exchanged.
fn exchanged(probe: &Probe<'_>, rng: &mut Xoshiro256PlusPlus) -> Option<Found> {
    const EXCHANGED: Slip = named("axes-exchanged");
    if probe.measure.variant != Variant::Anisotropic {
        return None;
    }
    const NAMES: [&str; 3] = ["x", "y", "z"];
    for (fine, axis) in DVec3::AXES.into_iter().enumerate() {
        let counts = DVec3::AXES.map(|along| changes(probe, along, 3.0 * axis, rng));
        let [Some(x), Some(y), Some(z)] = counts else { return None };
        let counts = [x, y, z];
        let others = (0..3).filter(|&other| other != fine);
        if let Some(most) = others.max_by_key(|&other| counts[other])
            && counts[most] > 4 * counts[fine].max(1)
        {
            let [along, beside] = [most, fine].map(|axis| (counts[axis], NAMES[axis]));
            let shown = format!(
                "where cells should be an eighth as long along {}, {} thresholds change along {} and {} along {}",
                beside.1, along.0, along.1, beside.0, beside.1
            );
            return Some(found(EXCHANGED, shown));
        }
    }
    None
}

/// The share of pairs of places on both sides of zero along an axis that have one threshold, `inside` of a cell along the others.
fn across_zero(probe: &Probe<'_>, inside: f64, sides: [f64; 2], rng: &mut Xoshiro256PlusPlus) -> f64 {
    let pair = |row: usize| {
        let axis = DVec3::AXES[row % 3];
        let other = (DVec3::ONE - axis) * (dvec3(index(rng), index(rng), index(rng)) + inside);
        sides.map(|side| other + axis * side)
    };
    let pairs: Vec<[DVec3; 2]> = (0..ROWS).map(pair).collect();
    probe.share(&pairs)
}
