//! GDC 2017.

use crate::maps::leaves;
use crate::measure::{
    Plane, answer, holds, list, listing, mean, outcome, percent, run_lengths, share, value,
};
use crate::row::{Measured, Row, judge};
use core::num::NonZeroU32;
use glam::DVec3;
use hashed_alpha::check::Draw;
use hashed_alpha::check::coordinates::{self, Coordinates, Stated, TableCell};
use hashed_alpha::check::subject::Precision::F32;
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::hash::sine::hash_3d;
use hashed_alpha::threshold::hash::{Cell, Hash, HashKind};
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::stage::coverage::regular;
use hashed_alpha::threshold::two_scale::Variant::Isotropic;
use std::sync::OnceLock;

pub const ROWS: &[Row] = &[
    Row {
        id: "slides.eighths",
        place: "Stochastic Alpha Thresholds Work",
        sentence: "Alpha-to-coverage of four samples tests against 1/8, 3/8, 5/8, 7/8.",
        measure: eighths,
    },
    Row {
        id: "slides.determinism",
        place: "Why Hashing?",
        sentence: "A fixed input gives the same value in each frame.",
        measure: determinism,
    },
    Row {
        id: "slides.range",
        place: "Why Hashing?",
        sentence: "The outputs of the hash are in [0, 1).",
        measure: range,
    },
    Row {
        id: "slides.caveat",
        place: "What Does This Mean?",
        sentence: "Hashing a position as it is, a tiny motion draws another value.",
        measure: caveat,
    },
    Row {
        id: "slides.discretise",
        place: "Achieving Hash Stability",
        sentence: "Hashing the floor of a position gives the same value after a small motion.",
        measure: discretise,
    },
    Row {
        id: "slides.scales",
        place: "What Does A Hash Scale Look Like?",
        sentence: "Hash scales 1, 3, 9 give noise of 1, 3, 9 pixels along each axis.",
        measure: scales,
    },
    Row {
        id: "slides.screen",
        place: "Coordinate Choice",
        sentence: "Screen coordinates: (yes), no, no, no, no, no.",
        measure: || coordinates_row(Coordinates::Screen),
    },
    Row {
        id: "slides.eye",
        place: "Coordinate Choice",
        sentence: "Eye coordinates: (yes), no, no, no, no, no.",
        measure: || coordinates_row(Coordinates::Eye),
    },
    Row {
        id: "slides.device",
        place: "Coordinate Choice",
        sentence: "Device coordinates: (yes), no, no, no, no, no.",
        measure: || coordinates_row(Coordinates::Device),
    },
    Row {
        id: "slides.texture",
        place: "Coordinate Choice",
        sentence: "Texture coordinates: yes, yes, yes, yes, yes, before deformation.",
        measure: || coordinates_row(Coordinates::Texture),
    },
    Row {
        id: "slides.world",
        place: "Coordinate Choice",
        sentence: "World coordinates: yes, yes, no, no, no, no.",
        measure: || coordinates_row(Coordinates::World),
    },
    Row {
        id: "slides.object",
        place: "Coordinate Choice",
        sentence: "Object coordinates: yes, yes, yes, yes, yes, before deformation.",
        measure: || coordinates_row(Coordinates::Object),
    },
    Row {
        id: "slides.one_minus",
        place: "Hashed Alpha Test Code",
        sentence: "In place of the clamp, 1 less the threshold would do.",
        measure: one_minus,
    },
    Row {
        id: "slides.mip_alpha",
        place: "Summary",
        sentence: "The alpha of each level is used as it is, as prefiltered visibility.",
        measure: mip_alpha,
    },
    Row {
        id: "slides.frames",
        place: "Temporal Antialiasing",
        sentence: "Thresholds fract(tau + i/N) can be averaged over frames.",
        measure: frames,
    },
];

fn eighths() -> Measured {
    let n = NonZeroU32::new(4).expect("not 0");
    let found = [0, 1, 2, 3].map(|i| regular::<f64>(i, n));
    judge(4_u64, found == [0.125, 0.375, 0.625, 0.875], false, list(found))
}

fn determinism() -> Measured {
    let outcome = outcome("determinism.two_passes", Isotropic, F32);
    judge(outcome.n, holds(&outcome), false, answer(&outcome))
}

fn range() -> Measured {
    let side = 1 << 12;
    let n = side * side;
    let hash =
        |i: i32| hash_3d::<f32>([(i % side - side / 2) as f32, (i / side - side / 2) as f32, 7.0].into());
    let outside = (0..n).filter(|&i| !(0.0..1.0).contains(&hash(i))).count();
    let zeros = share((0..n).map(|i| hash(i) == 0.0));
    let origin = hash_3d::<f32>([0.0, 0.0, 0.0].into()) == 0.0;
    let seen = format!(
        "f32, cells from -2048 to 2047: {outside} of {n} values outside; exactly 0 in {zeros:.1e} of the cells, at the origin always \
         ({origin})"
    );
    judge(n as u64, outside == 0, (outside as f64) < 1e-3 * f64::from(n), seen)
}

/// The share of points whose hash changes when they move by a thousandth of a pixel.
fn redrawn(index: fn(DVec3) -> DVec3) -> f64 {
    let plane = Plane::tilted(20.0, 1.0, 0.0);
    share((0..1 << 14).map(|i| {
        let point = plane.at(f64::from(i % 128) + 0.5, f64::from(i / 128) + 0.5).position;
        let hash = |point: DVec3| hash_3d::<f32>(index(point).as_vec3());
        hash(point) != hash(point + plane.dx * 1e-3)
    }))
}

fn caveat() -> Measured {
    let changed = redrawn(|point| point);
    judge(
        1 << 14,
        changed > 0.95,
        changed > 0.5,
        format!("a motion of 1/1000 pixel draws {} anew", percent(changed)),
    )
}

fn discretise() -> Measured {
    let changed = redrawn(DVec3::floor);
    judge(
        1 << 14,
        changed == 0.0,
        changed < 0.01,
        format!("a motion of 1/1000 pixel draws {} anew", percent(changed)),
    )
}

fn scales() -> Measured {
    let runs = [1.0, 3.0, 9.0].map(|scale| {
        mean((0..12).map(|i| {
            let plane = Plane::tilted(0.0, 0.01 * libm::exp2(f64::from(i) / 12.0), 0.5 * f64::from(i));
            let [x, y] = run_lengths(&plane.image(128, listing(Isotropic, scale)), 128);
            (x * y).sqrt()
        }))
    });
    let seen = format!(
        "runs of equal thresholds: {} pixels in the mean; the finer octave and the object's orientation shorten them",
        list(runs)
    );
    let near = [1.0, 3.0, 9.0].iter().zip(runs).all(|(scale, run)| (run / scale - 1.0).abs() < 0.15);
    judge(12 * 3 * 128 * 128, near, (runs[2] / runs[1] - 3.0).abs() < 0.6, seen)
}

fn entries() -> &'static [TableCell] {
    static TABLE: OnceLock<Vec<TableCell>> = OnceLock::new();
    TABLE.get_or_init(|| coordinates::table(&Draw::default()))
}

/// The share of pixels that keep their threshold where the image moves by so many pixels, hashed in coordinates in which
/// cells are pixels: those of the screen or device, and those of the eye on a frontal surface.
fn kept_on_screen(pixels: f64) -> f64 {
    let screen = Plane { dx: DVec3::X, dy: DVec3::Y, ..Plane::tilted(0.0, 1.0, 0.0) };
    let of = listing(Isotropic, 1.0);
    share((0..1 << 14).map(|i| {
        let [x, y] = [0, 1].map(|axis| 256.0 * value([i, axis, 51, 0]));
        of(&screen.at(x, y)) == of(&screen.at(x + 0.8 * pixels, y + 0.6 * pixels))
    }))
}

fn coordinates_row(kind: Coordinates) -> Measured {
    let row: Vec<&TableCell> = entries().iter().filter(|entry| entry.coordinates == kind).collect();
    let kept: Vec<String> = row.iter().map(|entry| percent(entry.kept)).collect();
    let (generous, plain): (Vec<&TableCell>, Vec<&TableCell>) =
        row.iter().partition(|entry| entry.stated == Stated::Generous);
    // What "somewhat generous" may mean: far surfaces hardly move in the image when the camera moves sideways.
    let far = kept_on_screen(MOTION_PIXELS / FAR);
    let generously = if generous.is_empty() {
        String::new()
    } else {
        format!(
            "; the generous yes needs surfaces {FAR} times as far, which a moving camera moves by {:.2} pixels: {} kept there",
            MOTION_PIXELS / FAR,
            percent(far)
        )
    };
    let seen = format!(
        "points that keep their threshold over a frame in which camera moves, camera turns, object moves, turns, is skinned, is \
         deformed: {}{generously}",
        kept.join(", ")
    );
    let plainly = plain.iter().all(|entry| entry.is_confirmed());
    judge(
        row.iter().map(|entry| entry.points).sum::<u64>(),
        plainly && generous.iter().all(|entry| entry.is_confirmed()),
        plainly && !generous.is_empty() && far > 0.9,
        seen,
    )
}

/// Pixels by which a frame of motion moves the middle of the image in the table of coordinates.
const MOTION_PIXELS: f64 = hashed_alpha::check::input::motion::MOTION_PIXELS;

/// How many times as far as in the table a surface is that counts as far.
const FAR: f64 = 100.0;

/// Thresholds of Listing 1 before its clamp, in `f32`, at a scale that is a power of two and at any other.
fn unclamped(size: f64) -> impl Iterator<Item = f32> {
    let plane = Plane { dx: DVec3::X * size, dy: DVec3::Y * size, ..Plane::tilted(0.0, size, 0.0) };
    (0..UNCLAMPED).map(move |i| {
        let footprint = plane.at(f64::from(i % 4096) + 0.5, f64::from(i / 4096) + 0.5).cast::<f32>();
        let trace = HashedAlpha::listing(Isotropic).trace(&footprint);
        CdfForm::Literal.cdf(trace.interpolated, trace.two_scale.lerp_factor)
    })
}

const UNCLAMPED: u32 = 1 << 22;

fn one_minus() -> Measured {
    let count = |size: f64, which: f32| unclamped(size).filter(|&tau| tau == which).count();
    let (powers, others) =
        ([0.0, 1.0].map(|which| count(1.0, which)), [0.0, 1.0].map(|which| count(0.7, which)));
    // The largest hash below 1 in both cells, half way between two scales.
    let extreme = 1.0 - CdfForm::Literal.cdf(1.0 - f32::EPSILON / 2.0, 0.5_f32);
    let seen = format!(
        "thresholds before the clamp that are 0, and that are 1, so that 1 less them is 0: {} and {} at derivatives of a power \
         of two, {} and {} at others; two hashes as large as f32 has below 1, half way between the scales: 1 less the threshold is {extreme}, \
         which keeps alpha 0",
        powers[0], powers[1], others[0], others[1]
    );
    judge(2 * UNCLAMPED, powers[1] + others[1] == 0 && extreme > 0.0, powers[1] == 0 && powers[0] > 0, seen)
}

fn mip_alpha() -> Measured {
    let chain = leaves(256).chain();
    let kept = |level: usize| {
        let texels = &chain[level].texels;
        mean((0..1 << 16).map(|i: u32| {
            let alpha = f64::from(texels[i as usize % texels.len()]);
            f64::from(u8::from(alpha >= value([i, level as u32, 50, 0])))
        }))
    };
    let (found, truth) = ([0, 2, 4, 6, 8].map(kept), chain[0].level().mean());
    let near = found.iter().all(|kept| (kept - truth).abs() < 0.01);
    judge(5 << 16, near, false, format!("kept at levels 0, 2, 4, 6, 8: {} of {truth:.3}", list(found)))
}

fn frames() -> Measured {
    let outcome = outcome_of_frames();
    let seen = format!("mean of eight frames, largest error over nine alphas: {outcome:.4}");
    judge(1 << 15, outcome < 0.126, outcome < 0.2, seen)
}

/// The largest error of the mean of eight stratified frames in any pixel.
fn outcome_of_frames() -> f64 {
    let n = NonZeroU32::new(8).expect("not 0");
    let cell = |i: i32| Cell::<f32> { index: [(i % 64) as f32, (i / 64) as f32, 3.0].into(), octave: 1 };
    (0..4096)
        .flat_map(|i| (1..10).map(move |a| (i, f64::from(a) / 10.0)))
        .map(|(i, alpha)| {
            let chi = f64::from(HashKind::Mm4.hash(&cell(i)));
            let kept = (0..8)
                .filter(|&f| alpha >= hashed_alpha::threshold::stage::stratify::stratified(chi, f, n))
                .count();
            (kept as f64 / 8.0 - alpha).abs()
        })
        .fold(0.0, f64::max)
}
