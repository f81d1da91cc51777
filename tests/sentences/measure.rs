//! What several rows measure with.

use core::num::NonZeroU32;
use glam::{DQuat, DVec3, dvec3};
use hashed_alpha::check::subject::Precision;
use hashed_alpha::check::{Draw, Outcome, Subject, Verdict, claims, run_claims};
use hashed_alpha::technique::history::flicker_range;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::mm4::murmur3;
use hashed_alpha::threshold::hash::open_lattice;
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::two_scale::Variant;

/// A uniform value that belongs to four words.
pub fn value(words: [u32; 4]) -> f64 {
    open_lattice(murmur3(words))
}

/// A number of samples, frames or strata.
pub fn n(samples: u32) -> NonZeroU32 {
    NonZeroU32::new(samples).expect("not 0")
}

/// Thresholds in the middle of equal parts of (0, 1).
pub fn chis() -> impl Iterator<Item = f64> {
    (0..CHIS).map(|i| (f64::from(i) + 0.5) / f64::from(CHIS))
}

/// The share of a sequence that is true.
pub fn share(events: impl IntoIterator<Item = bool>) -> f64 {
    mean(events.into_iter().map(|event| f64::from(u8::from(event))))
}

pub fn mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let (sum, count) = values.into_iter().fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / count
}

/// The root of the mean square.
pub fn rms(values: impl IntoIterator<Item = f64>) -> f64 {
    mean(values.into_iter().map(|value| value * value)).sqrt()
}

pub fn visible(alpha: f64, threshold: f64) -> f64 {
    f64::from(u8::from(alpha >= threshold))
}

/// Writes a share in percent.
pub fn percent(share: f64) -> String {
    let places = if share != 0.0 && share.abs() < 0.01 { 2 } else { 1 };
    format!("{:.places$} %", 100.0 * share)
}

/// Writes numbers with three digits after the point.
pub fn list(values: impl IntoIterator<Item = f64>) -> String {
    values.into_iter().map(|value| format!("{value:.3}")).collect::<Vec<_>>().join(", ")
}

/// A plane in general position, seen by a camera so far away that its derivatives are constant.
#[derive(Clone, Copy)]
pub struct Plane {
    pub origin: DVec3,
    pub dx: DVec3,
    pub dy: DVec3,
}

impl Plane {
    /// A plane of which one pixel covers `size` units along screen x, tilted away along screen y.
    pub fn tilted(degrees: f64, size: f64, turn: f64) -> Self {
        let rotation = DQuat::from_axis_angle(dvec3(0.48, -0.6, 0.64), 0.7 + turn);
        let cosine = libm::cos(degrees.to_radians());
        Self {
            origin: dvec3(3.17, -1.73, 4.31),
            dx: rotation * DVec3::X * size,
            dy: rotation * DVec3::Y * (size / cosine),
        }
    }

    pub fn at(&self, x: f64, y: f64) -> Footprint<f64> {
        Footprint { position: self.origin + x * self.dx + y * self.dy, dpdx: self.dx, dpdy: self.dy }
    }

    /// The thresholds of a square of pixels by a function of footprints.
    pub fn image(&self, side: u32, threshold: impl Fn(&Footprint<f64>) -> f64) -> Vec<f64> {
        (0..side * side)
            .map(|i| threshold(&self.at(f64::from(i % side) + 0.5, f64::from(i / side) + 0.5)))
            .collect()
    }
}

/// A listing with the paper's hash in `f32`.
pub fn listing(variant: Variant, hash_scale: f64) -> impl Fn(&Footprint<f64>) -> f64 + Copy {
    let listing = HashedAlpha { hash_scale, ..HashedAlpha::listing(variant) };
    move |footprint| f64::from(listing.threshold(&footprint.cast::<f32>()))
}

/// How long the runs of equal thresholds are in the mean, along x and along y, in pixels.
pub fn run_lengths(image: &[f64], side: usize) -> [f64; 2] {
    let equal = |step: usize, stays: &dyn Fn(usize) -> bool| {
        share((0..image.len()).filter(|&i| stays(i)).map(|i| image[i] == image[i + step]))
    };
    let along_x = equal(1, &|i| i % side + 1 < side);
    let along_y = equal(side, &|i| i / side + 1 < side);
    [along_x, along_y].map(|equal| 1.0 / (1.0 - equal))
}

/// The outcome of a claim of the crate for a listing.
pub fn outcome(claim: &str, variant: Variant, precision: Precision) -> Outcome {
    let subject = Subject::paper().into_iter().find(|s| s.variant == variant && s.precision == precision);
    tried(claim, subject.expect("all four are there"))
}

pub fn tried(claim: &str, subject: Subject<'_>) -> Outcome {
    let claim = claims::ALL.iter().copied().find(|known| known.id == claim).expect("a claim of that name");
    run_claims(&[claim], &[subject], &Draw::default(), || {}).remove(0)
}

pub fn holds(outcome: &Outcome) -> bool {
    outcome.verdict == Verdict::Consistent
}

/// Writes what a claim of the crate answered.
pub fn answer(outcome: &Outcome) -> String {
    let p = outcome.p.map_or(String::new(), |p| format!(", p = {p:.1e}"));
    format!("`{}` of {} in {}: {}{p}", outcome.check, outcome.subject, outcome.precision, outcome.verdict)
}

/// The mean range within which the exponential average (weight 0.1) of a cycle of eight frames moves for ever.
pub fn flicker(alpha: f64, threshold: impl Fn(f64, u32) -> f64) -> f64 {
    mean(chis().map(|chi| {
        let frames: Vec<f64> = (0..8).map(|frame| visible(alpha, threshold(chi, frame))).collect();
        flicker_range(&frames, 0.1)
    }))
}

/// Hash values over which a flicker is averaged.
pub const CHIS: u32 = 4096;

/// A threshold of its own for each frame of a hash value.
pub fn independent(chi: f64, frame: u32) -> f64 {
    value([(chi * f64::from(CHIS)) as u32, frame, 77, 0])
}
