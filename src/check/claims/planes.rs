//! Planes on which real models lie: parallel to two axes, at zero, at a tenth, at a half, at a whole number.
//!
//! The closed form for the share of thresholds that a motion changes is about positions that are spread evenly over
//! the cells. On a plane of constant z the coordinate z is the same everywhere, up to the rounding of the rasteriser:
//! where a listing divides by that rounding, or cuts its cells just there, thresholds change from frame to frame.
//!
//! Every sample has a camera and a place of its own, so samples share no more than a choice of octaves; the constant
//! coordinate stays exact.

use crate::check::evidence::ComparedShare;
use crate::check::input::placement;
use crate::check::judge::detectable_error;
use crate::check::predict::Changes;
use crate::check::shrink::describe;
use crate::check::{Attempt, Claim, Conclusion, Draw, Evidence, Promise, Subject, Trial, Verdict};
use crate::scene::{Camera, Fragment, Raster, Rectangle};
use crate::stats::poisson_binomial;
use crate::stats::seed::uniform01;
use glam::{DVec2, DVec3, dvec2, dvec3};
use rand::rngs::Xoshiro256PlusPlus;
use std::f64::consts::TAU;

/// Pairs of frames on each rasterised plane: shows an excess of 0.007 over a share of 0.02, less than grids make that
/// are not nested, a fortieth of what a plane on the faces of cells makes.
const RASTER_SAMPLES: usize = 1 << 15;

/// Pixels of the rasterised image: a pixel is then about a hundredth of the plane, as on a card in a real frame.
const RASTER_RESOLUTION: [u32; 2] = [256, 192];

/// Half a side of a rasterised plane, in object units.
const PLANE_HALF_SIDE: f64 = 1.0;

/// The image moves by this many pixels between two frames: far below a cell, so that few thresholds should change.
const FRAME_SHIFT: f64 = 0.012;

/// A threshold that moves further between two frames is another draw. The derivatives of two frames differ by their
/// rounding and by perspective, 1e-3 of an octave at most, and a continuous threshold follows them; a new draw is
/// nearer than this in one case of 128.
const REDRAW: f64 = 1.0 / 256.0;

/// Planes at zero and at decimal fractions: one coordinate has no derivative, or only rounding.
pub const AXIS_ALIGNED: Claim = Claim {
    id: "planes.axis_aligned",
    anchor: "§6.2, Listing 2; rasterised planes not in the paper",
    statement: "on planes of constant y or z = 0, 0.1, 0.3 every threshold is a number in (0, 1], and a shift of \
                0.012 pixels redraws no more of them than the size of the cells predicts",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.03)),
    run: |subject, draw| trial(&AXIS_ALIGNED, &[0.0, 0.1, 0.3], subject, draw),
};

/// Planes at powers of two and whole numbers: faces of cells in every octave, for cells cut at whole numbers.
pub const DYADIC: Claim = Claim {
    id: "planes.dyadic",
    anchor: "§5, Listings 1 and 2 (floor of the scaled position); rasterised planes not in the paper",
    statement: "on planes of constant y or z = 0.5, 1, 2, 3 every threshold is a number in (0, 1], and a shift of \
                0.012 pixels redraws no more of them than the size of the cells predicts",
    expected: Verdict::Consistent,
    promise: Some(Promise::Root(0.03)),
    run: |subject, draw| trial(&DYADIC, &[0.5, 1.0, 2.0, 3.0], subject, draw),
};

/// One pixel before and after the image moved by a fraction of it.
struct Seen {
    before: Fragment,
    after: Fragment,
    /// How far apart the two points of the surface really are, in object units.
    motion: DVec3,
}

/// What was counted on one plane.
#[derive(Default)]
struct Counts {
    /// Pixels with a threshold in both frames.
    valid: usize,
    /// Pixels with a threshold that is no number in (0, 1], in one frame or the other.
    invalid: usize,
    /// Valid pixels with another threshold afterwards.
    redrawn: usize,
    /// How many of the valid pixels are expected to change.
    expected: Changes,
    first_invalid: Option<String>,
}

impl Counts {
    fn words(&self) -> String {
        let mut words = Vec::new();
        if self.invalid > 0 {
            let share = self.invalid as f64 / (self.valid + self.invalid) as f64;
            words.push(format!("{:.1} % are no number in (0, 1]", 100.0 * share));
        }
        if self.valid > 0 {
            let share = |count: f64| 100.0 * count / self.valid as f64;
            let (measured, predicted) = (share(self.redrawn as f64), share(self.expected.mean));
            words.push(format!("{measured:.2} % redrawn for {predicted:.2} % predicted"));
        }
        words.join(", ")
    }
}

fn trial(claim: &Claim, offsets: &[f64], subject: &Subject<'_>, draw: &Draw) -> Attempt<Trial> {
    let mut rng = draw.rng(claim.id);
    let (mut points, mut seen, mut first_invalid) = (Vec::new(), Vec::new(), None);
    let (mut least_p, mut worst_z) = (1.0_f64, f64::NEG_INFINITY);
    let (mut n, mut invalid) = (0, 0);
    for (normal, name) in [(2, "z"), (1, "y")] {
        for &offset in offsets {
            let counts = counts(subject, normal, offset, draw.samples(RASTER_SAMPLES), &mut rng);
            seen.push(format!("{name} = {offset}: {}", counts.words()));
            n += counts.valid + counts.invalid;
            invalid += counts.invalid;
            if counts.valid > 0 {
                let (mean, variance) = (counts.expected.mean, counts.expected.variance());
                let test = poisson_binomial::sum_of_events(counts.redrawn as u64, mean, variance);
                // One side: a new threshold too close to the old one is missing from the count.
                least_p = least_p.min(if test.z > 0.0 { 0.5 * test.p } else { 1.0 });
                worst_z = worst_z.max(test.z);
                let valid = counts.valid as f64;
                points.push(ComparedShare {
                    series: format!("planes of constant {name}"),
                    x: offset,
                    measured: counts.redrawn as f64 / valid,
                    predicted: mean / valid,
                    sigma: variance.sqrt() / valid,
                });
            }
            first_invalid = first_invalid.or(counts.first_invalid);
        }
    }
    if let Some(first) = first_invalid {
        seen.push(format!("as in {first}"));
    }
    let excess = points.iter().map(|point| point.measured - point.predicted).reduce(f64::max);
    let (conclusion, statistic, statistic_name) = if invalid > 0 {
        (Conclusion::Exact { holds: false }, invalid as f64, "thresholds outside (0, 1]".into())
    } else {
        let p = (least_p * points.len() as f64).min(1.0);
        (Conclusion::Probability(p), worst_z, format!("z, worst of {}", points.len()))
    };
    Ok(Trial {
        conclusion,
        statistic: Some(statistic),
        statistic_name,
        n: n as u64,
        effect: excess,
        effect_name: "excess in the share that is redrawn",
        detectable: detectable_error(&points),
        seen: seen.join("; "),
        evidence: Evidence::Shares { abscissa: "offset of the plane [object units]", points },
    })
}

fn counts(
    subject: &Subject<'_>,
    normal: usize,
    offset: f64,
    n: usize,
    rng: &mut Xoshiro256PlusPlus,
) -> Counts {
    let samples: Vec<Seen> = (0..n).map(|_| seen(normal, offset, rng)).collect();
    let thresholds =
        |of: fn(&Seen) -> Fragment| subject.thresholds(&samples.iter().map(of).collect::<Vec<_>>());
    let (before, after) = (thresholds(|seen| seen.before), thresholds(|seen| seen.after));
    let is_valid = |threshold: f64| threshold > 0.0 && threshold <= 1.0;
    let mut counts = Counts::default();
    for ((seen, old), new) in samples.iter().zip(before).zip(after) {
        if is_valid(old) && is_valid(new) {
            counts.valid += 1;
            counts.expected.add(subject, &seen.before.footprint, seen.motion);
            counts.redrawn += usize::from((old - new).abs() > REDRAW);
        } else {
            let (fragment, threshold) = if is_valid(old) { (&seen.after, new) } else { (&seen.before, old) };
            counts.invalid += 1;
            counts.first_invalid.get_or_insert_with(|| {
                describe(subject, fragment, |_, value| {
                    !is_valid(value) && value.is_nan() == threshold.is_nan()
                })
            });
        }
    }
    counts
}

/// Draws cameras until one sees the plane, at a pixel that still sees it in the next frame.
fn seen(normal: usize, offset: f64, rng: &mut Xoshiro256PlusPlus) -> Seen {
    loop {
        if let Some(seen) = attempt(normal, offset, rng) {
            return seen;
        }
    }
}

fn attempt(normal: usize, offset: f64, rng: &mut Xoshiro256PlusPlus) -> Option<Seen> {
    let across = [(normal + 1) % 3, (normal + 2) % 3].map(|axis| DVec3::AXES[axis]);
    // The constant coordinate is what a vertex can hold.
    let height = DVec3::AXES[normal] * f64::from(offset as f32);
    let placed = placement(rng);
    let centre = placed - DVec3::AXES[normal] * placed[normal] + height;
    let rectangle =
        Rectangle { centre, half_u: across[0] * PLANE_HALF_SIDE, half_v: across[1] * PLANE_HALF_SIDE };
    // From straight above down to 11 degrees over the plane, from either side, at every turn of the camera.
    let mut between = |low: f64, high: f64| low + (high - low) * uniform01(rng);
    let rise = between(0.2, 1.0) * if between(0.0, 1.0) < 0.5 { -1.0 } else { 1.0 };
    let azimuth = between(0.0, TAU);
    let level = (1.0 - rise * rise).sqrt();
    let to_eye = across[0] * (level * libm::cos(azimuth))
        + across[1] * (level * libm::sin(azimuth))
        + DVec3::AXES[normal] * rise;
    let distance = between(1.5, 4.0) * PLANE_HALF_SIDE;
    let up = dvec3(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0));
    let camera = Camera::look_at(centre + to_eye * distance, centre, up, 0.4, RASTER_RESOLUTION);
    let [width, height] = camera.resolution;
    let pixel = [between(0.0, f64::from(width)) as u32, between(0.0, f64::from(height)) as u32];
    let turn = between(0.0, TAU);
    let shift = dvec2(libm::cos(turn), libm::sin(turn)) * FRAME_SHIFT;
    let seen_at = dvec2(f64::from(pixel[0]) + 0.5, f64::from(pixel[1]) + 0.5);
    let rasterised = |shift: DVec2| {
        let footprint = Raster::new(&camera, &rectangle, shift)?.footprint(pixel)?.cast();
        let exact = rectangle.fragment(&camera, seen_at - shift)?;
        Some(Fragment { footprint, pixel: seen_at, ..exact })
    };
    let (before, after) = (rasterised(DVec2::ZERO)?, rasterised(shift)?);
    Some(Seen { before, after, motion: after.world - before.world })
}
