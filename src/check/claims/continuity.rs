//! The threshold moves without jumps while the view of a fixed point of the surface does.
//!
//! Only the derivatives change: the position stays in its cells. Between two views the threshold may change by no
//! more than the join allows for the change of the scales, and the step in which the subject's own values are stored; whatever
//! goes beyond is a *pop*. The dithered join is
//! continuous in law only: it may switch once an octave and axis, at a place of its own in every cell.

use crate::check::input::{
    Start, UsedCells, at_scale, draw_cell, numerator, placement, tangents, tilted, turned, zoomed,
};
use crate::check::judge::pops::Pops;
use crate::check::predict::octaves_between;
use crate::check::subject::Nominal;
use crate::check::tolerance::TILT_OCTAVES;
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Claim, Conclusion, Draw, Precision, Promise, Subject, Trial, Verdict};
use crate::scene::Fragment;
use crate::stats::{binomial, seed};
use crate::threshold::footprint::Footprint;
use crate::threshold::two_scale::Variant;
use core::f64::consts::FRAC_PI_2;
use glam::{DVec3, dvec3};
use rand::rngs::Xoshiro256PlusPlus;

/// Points whose thresholds are followed under zoom, rotation and tilt: a pop in one of 200 points and octaves shows.
const SWEEP_POINTS: usize = 64;

/// Octaves that the scale goes through under zoom: three powers of two along each axis.
const ZOOM_OCTAVES: f64 = 3.0;

/// Octaves between two views: the steepest join then moves by less than 0.02 a step, where a pop has a mean of 1/3.
const LOG_SCALE_STEP: f64 = 1.0 / 2048.0;

/// Radians between two views of a turn; no scale moves by more than log2(e) octaves a radian.
const TURN_STEP: f64 = 1.0 / 3072.0;

/// Octaves at whose beginning the threshold is followed: indices in them have one to three digits.
const BOUNDARY_OCTAVES: core::ops::RangeInclusive<i32> = -2..=6;

/// Points at each power of two: log2 and its floor disagree within few roundings, and at every point if at any.
const BOUNDARY_POINTS: usize = 1 << 11;

/// Roundings on each side of a power of two: log2 in `f32` rounds up to two of them to the power up to 2^8.
const BOUNDARY_ULPS: i32 = 8;

/// Octaves by which the other axes are finer there: both derivatives together stay shorter than the first, and no
/// shorter than the 2^-5 at which a floor would tie them to it.
const OTHER_AXES: [f64; 2] = [0.6, 3.0];

/// No pops while the camera comes closer.
pub const ZOOM: Claim = Claim {
    id: "continuity.zoom",
    anchor: "§5.4.2 (interpolating between two scales), §6.2",
    statement: "while the camera comes closer, the threshold of a fixed point changes without jumps",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.2)),
    run: |subject, draw| {
        let zoom = Sweep {
            steps: (ZOOM_OCTAVES / LOG_SCALE_STEP) as usize,
            length: ZOOM_OCTAVES,
            monotone: true,
            effect_name: "pops per point and octave",
            derivatives: |tangents, at| zoomed(tangents, ZOOM_OCTAVES * at),
        };
        sweep(subject, draw, ZOOM.id, &zoom)
    },
};

/// No pops while the camera turns about its line of sight.
pub const ROTATION: Claim = Claim {
    id: "continuity.rotation",
    anchor: "§6.2 (one scale an axis)",
    statement: "while the object turns about the line of sight, the threshold of a fixed point changes without jumps",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.5)),
    run: |subject, draw| {
        let quarter_turn = Sweep {
            steps: (FRAC_PI_2 / TURN_STEP) as usize,
            length: 1.0,
            monotone: false,
            effect_name: "pops per point and quarter turn",
            derivatives: |tangents, at| turned(tangents, FRAC_PI_2 * at),
        };
        sweep(subject, draw, ROTATION.id, &quarter_turn)
    },
};

/// No pops while the surface tilts away from the camera.
pub const TILT: Claim = Claim {
    id: "continuity.tilt",
    anchor: "§6 (surfaces at grazing angles)",
    statement: "while the surface tilts to 85 degrees, the threshold of a fixed point changes without jumps",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(0.5)),
    run: |subject, draw| {
        let tilt = Sweep {
            steps: (TILT_OCTAVES / LOG_SCALE_STEP) as usize,
            length: 1.0,
            monotone: true,
            effect_name: "pops per point and tilt from 0 to 85 degrees",
            derivatives: |tangents, at| tilted(tangents, TILT_OCTAVES * at),
        };
        sweep(subject, draw, TILT.id, &tilt)
    },
};

/// No pop within a few roundings of a power of two.
pub const OCTAVE_BOUNDARY: Claim = Claim {
    id: "continuity.octave_boundary",
    anchor: "§5, Listings 1 and 2 (floor, ceil and fract of log2)",
    statement: "across a power of two, rounding by rounding, the threshold changes by no more than roundings",
    expected: Verdict::Consistent,
    promise: Some(Promise::Linear(2.0e-3)),
    run: octave_boundary,
};

/// A change of the view of a point.
struct Sweep {
    /// Number of steps.
    steps: usize,
    /// How often the unit of the effect fits into the whole motion.
    length: f64,
    /// Whether every scale only grows or only shrinks.
    monotone: bool,
    effect_name: &'static str,
    /// The derivatives at a part in [0, 1] of the motion, from two tangents of equal length at right angles.
    derivatives: fn([DVec3; 2], f64) -> [DVec3; 2],
}

fn sweep(subject: &Subject<'_>, draw: &Draw, claim: &str, motion: &Sweep) -> Attempt<Trial> {
    if subject.join.switches() && !motion.monotone {
        let reason = "a join that takes one of two octaves switches as often as a scale passes the place of its cell; \
                      continuity.zoom and continuity.tilt, where each passes once, count the switches";
        return Ok(Trial::without(Conclusion::NotApplicable, reason));
    }
    let rng = &mut draw.rng(claim);
    let points = draw.samples(SWEEP_POINTS);
    let mut pops = Pops::default();
    for _ in 0..points {
        let position = placement(rng);
        let (tangents, start) = (tangents(rng), Start::draw(rng));
        let views: Vec<Fragment> = (0..=motion.steps)
            .map(|step| {
                let [dpdx, dpdy] = (motion.derivatives)(tangents, step as f64 / motion.steps as f64);
                start.seeing(subject.precision.round(&Footprint { position, dpdx, dpdy }))
            })
            .collect();
        let thresholds = subject.thresholds(&views);
        reject_outsiders(subject, &views, &thresholds)?;
        pops.add_path(subject, &views, &thresholds);
    }
    let motions = points as f64 * motion.length;
    Ok(pops.into_trial(subject, motions, motion.effect_name))
}

fn octave_boundary(subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(OCTAVE_BOUNDARY.id);
    let mut pops = Pops::default();
    let (mut changes, mut expected) = (0, 0.0);
    let mut used = UsedCells::default();
    for octave in BOUNDARY_OCTAVES {
        for _ in 0..draw.samples(BOUNDARY_POINTS) {
            let views = across_octave(subject, octave, &mut rng);
            if !used.claim(subject, &views[..1]) {
                continue;
            }
            let thresholds = subject.thresholds(&views);
            reject_outsiders(subject, &views, &thresholds)?;
            pops.add_jumps(subject, &views, &thresholds);
            changes += thresholds.windows(2).filter(|pair| pair[0] != pair[1]).count() as u64;
            let nominal: Vec<Nominal> = views.iter().map(|view| subject.nominal(&view.footprint)).collect();
            expected += nominal.windows(2).flat_map(|pair| octaves_between(&pair[0], &pair[1])).sum::<f64>();
        }
    }
    let crossings = pops.steps as f64 / f64::from(2 * BOUNDARY_ULPS);
    let mut trial = pops.into_trial(subject, crossings, "pops per point and power of two");
    if subject.join.switches() {
        // A switch falls into a step with the probability of its length.
        trial.conclusion = Conclusion::Probability(binomial::poisson_upper_p(changes, expected));
    }
    Ok(trial)
}

/// Footprints of one point whose scale along one axis goes through 2^octave, one rounding at a time.
///
/// The other axes have finer scales in general position, and shorter derivatives in sum.
fn across_octave(subject: &Subject<'_>, octave: i32, rng: &mut Xoshiro256PlusPlus) -> Vec<Fragment> {
    let side = libm::exp2(f64::from(-octave));
    let position = draw_cell(rng) * side + side * dvec3(0.4, 0.3, 0.6);
    let axis = (3.0 * seed::uniform01(rng)) as usize;
    let start = Start::draw(rng);
    let [low, high] = OTHER_AXES;
    let log_scale = [0, 1, 2]
        .map(|a| f64::from(octave) + if a == axis { 0.0 } else { low + (high - low) * seed::uniform01(rng) });
    let others = at_scale(Variant::Anisotropic, subject.hash_scale, position, log_scale);
    let at_boundary = numerator(subject.variant) * side / subject.hash_scale;
    (-BOUNDARY_ULPS..=BOUNDARY_ULPS)
        .map(|ulps| {
            let mut dpdy = others.dpdx;
            dpdy[axis] = 0.0;
            let dpdx = DVec3::AXES[axis] * ulps_away(subject.precision, at_boundary, ulps);
            start.seeing(subject.precision.round(&Footprint { position, dpdx, dpdy }))
        })
        .collect()
}

/// The number that is so many roundings above `x` > 0.
fn ulps_away(precision: Precision, x: f64, ulps: i32) -> f64 {
    match precision {
        Precision::F32 => f64::from(f32::from_bits((x as f32).to_bits().wrapping_add_signed(ulps))),
        Precision::F64 => f64::from_bits(x.to_bits().wrapping_add_signed(i64::from(ulps))),
    }
}
