//! Grain: how much the noise of what is visible can be seen from afar, as a number; and how much of it changes.
//!
//! *Grain* is the power of the picture of visibility (0 or 1 at an alpha) at frequencies below 1/16 of a cycle a pixel, divided by
//! alpha (1 - alpha): 1 for noise without any order, less for noise that the eye averages away, more for clumps. It is a
//! number and no claim, since no law says how much there should be. Not in the paper, which shows it in pictures (Fig. 8).

use crate::check::Subject;
use crate::check::input::patch::{Patch, Start, rotation};
use crate::check::input::placement;
use crate::check::tolerance::WIDE;
use crate::check::trial::reject_outsiders;
use crate::scene::Fragment;
use crate::stats::{seed, spectrum};
use crate::threshold::footprint::Footprint;
use glam::{DMat3, DVec2, DVec3, dvec2};
use rand::rngs::Xoshiro256PlusPlus;

/// The alphas at which visibility is looked at.
pub const ALPHAS: [f64; 3] = [0.1, 0.25, 0.5];

/// Pixels along each side of a picture, which has no other window.
pub const SIDE: usize = 256;

/// Frequencies from this one on do not count, in cycles a pixel.
pub const BAND: f64 = 1.0 / 16.0;

/// By how much a picture is moved to count what changes, in pixels.
pub const MOTION: f64 = 0.125;

/// Pictures of each kind of surface; a quarter of them at each of the [`FRACTIONS`].
const PICTURES: usize = 24;

/// Where between two octaves the longest derivative lies.
const FRACTIONS: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// The octave of the longest derivative: a coordinate has some ten bits left within a pixel.
pub(super) const OCTAVE: f64 = -6.0;

/// How many times the one derivative is as long as the other at a grazing angle.
const STRETCH: f64 = 8.0;

/// Points that are followed while the camera comes an octave closer: a share of 1/3 has a standard error of 1 in 100.
const POINTS: usize = 1 << 14;

/// Steps on the way: a point that changes twice within one is not counted.
const STEPS: usize = 32;

/// How a surface lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// In the plane of two axes of the object, which the screen follows, as most of what is built by hand.
    Axis,
    /// In any direction.
    General,
    /// In any direction, seen at an angle at which a pixel is eight times as long as it is wide.
    Grazing,
}

impl Plane {
    /// Every way.
    pub const ALL: [Self; 3] = [Self::Axis, Self::General, Self::Grazing];

    /// The words in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Axis => "axis plane",
            Self::General => "general position",
            Self::Grazing => "grazing angle",
        }
    }

    fn draw(self, subject: &Subject<'_>, picture: usize, rng: &mut Xoshiro256PlusPlus) -> Patch {
        let fraction = FRACTIONS[picture % FRACTIONS.len()];
        let longest = libm::exp2(OCTAVE + fraction) / subject.hash_scale;
        let (turn, shorter) = match self {
            Self::Axis => {
                let axes = DVec3::AXES;
                let first = picture / FRACTIONS.len() % axes.len();
                (DMat3::from_cols(axes[first], axes[(first + 1) % 3], axes[(first + 2) % 3]), 1.0)
            }
            Self::General => (rotation(rng), 1.0),
            Self::Grazing => (rotation(rng), 1.0 / STRETCH),
        };
        let drawn = Footprint {
            position: DVec3::ZERO,
            dpdx: turn.x_axis * (longest * shorter),
            dpdy: turn.y_axis * longest,
        };
        let Footprint { dpdx, dpdy, .. } = subject.precision.round(&drawn);
        Patch { dpdx, dpdy }
    }
}

/// What pictures of one kind of surface show at one alpha.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// How the surface lies.
    pub plane: Plane,
    /// Alpha of every fragment.
    pub alpha: f64,
    /// The grain: 1 for noise without order.
    pub grain: f64,
    /// Its standard error, from picture to picture.
    pub error: f64,
    /// Share of the pixels whose fragment appears or vanishes when the surface moves by [`MOTION`] along x.
    pub flips: f64,
}

/// Share of points that appear or vanish while the camera comes an octave closer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ZoomFlips {
    /// Alpha of every fragment.
    pub alpha: f64,
    /// How often a point does.
    pub flips: f64,
    /// Its standard error.
    pub error: f64,
}

/// Measures the grain of a subject in [`Plane::ALL`] at [`ALPHAS`], in that order. Of one seed always the same.
///
/// # Errors
///
/// In words, where the subject has no threshold in (0, 1] of a fragment.
pub fn grain(subject: &Subject<'_>, seed: u64) -> Result<Vec<Grain>, String> {
    let mut rng = seed::rng("grain", seed);
    let mut all = Vec::new();
    for plane in Plane::ALL {
        let mut powers = [(); ALPHAS.len()].map(|()| Vec::new());
        let mut flips = [0_usize; ALPHAS.len()];
        for picture in 0..PICTURES {
            let patch = plane.draw(subject, picture, &mut rng);
            let start = Start::draw(&mut rng);
            let before = thresholds(subject, &patch, &start, DVec2::ZERO)?;
            let after = thresholds(subject, &patch, &start, dvec2(MOTION, 0.0))?;
            for (at, &alpha) in ALPHAS.iter().enumerate() {
                powers[at].push(power(&before, alpha)?);
                flips[at] +=
                    before.iter().zip(&after).filter(|(a, b)| (**a <= alpha) != (**b <= alpha)).count();
            }
        }
        for (at, alpha) in ALPHAS.into_iter().enumerate() {
            let (grain, error) = mean_and_error(&powers[at]);
            let flips = flips[at] as f64 / (PICTURES * SIDE * SIDE) as f64;
            all.push(Grain { plane, alpha, grain, error, flips });
        }
    }
    Ok(all)
}

/// Follows points of surfaces in general position for an octave, at [`ALPHAS`]. Of one seed always the same.
///
/// # Errors
///
/// As [`grain`].
pub fn zoom_flips(subject: &Subject<'_>, seed: u64) -> Result<Vec<ZoomFlips>, String> {
    let mut rng = seed::rng("grain.zoom", seed);
    let mut counts = [(); ALPHAS.len()].map(|()| Vec::with_capacity(POINTS));
    for _ in 0..POINTS {
        let turn = rotation(&mut rng);
        let (position, start) = (placement(&mut rng) * WIDE, Start::draw(&mut rng));
        let first = OCTAVE + seed::uniform01(&mut rng);
        let views: Vec<Fragment> = (0..=STEPS)
            .map(|step| {
                let longest = libm::exp2(first - step as f64 / STEPS as f64) / subject.hash_scale;
                let (dpdx, dpdy) = (turn.x_axis * longest, turn.y_axis * longest);
                start.seeing(subject.precision.round(&Footprint { position, dpdx, dpdy }))
            })
            .collect();
        let values = values(subject, &views)?;
        for (count, alpha) in counts.iter_mut().zip(ALPHAS) {
            let changes = values.windows(2).filter(|pair| (pair[0] <= alpha) != (pair[1] <= alpha)).count();
            count.push(changes as f64);
        }
    }
    let of = |(alpha, count): (f64, &Vec<f64>)| {
        let (flips, error) = mean_and_error(count);
        ZoomFlips { alpha, flips, error }
    };
    Ok(ALPHAS.into_iter().zip(&counts).map(of).collect())
}

/// The thresholds of a picture, row by row.
fn thresholds(subject: &Subject<'_>, patch: &Patch, start: &Start, moved: DVec2) -> Result<Vec<f64>, String> {
    let places = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| dvec2(x as f64, y as f64)));
    let fragments: Vec<Fragment> =
        places.map(|place| patch.fragment(subject, start, place + moved)).collect();
    values(subject, &fragments)
}

pub(super) fn values(subject: &Subject<'_>, fragments: &[Fragment]) -> Result<Vec<f64>, String> {
    let values = subject.thresholds(fragments);
    reject_outsiders(subject, fragments, &values).map_err(|trial| trial.seen.clone())?;
    Ok(values)
}

/// The grain of one picture.
fn power(thresholds: &[f64], alpha: f64) -> Result<f64, String> {
    let visible: Vec<f64> = thresholds.iter().map(|&value| f64::from(u8::from(value <= alpha))).collect();
    let periodogram = spectrum::periodogram(&visible, [SIDE; 2]).map_err(|error| error.to_string())?;
    let cycles = |k: usize| k.min(SIDE - k) as f64 / SIDE as f64;
    let low = periodogram.iter().enumerate().filter(|(index, _)| {
        let (x, y) = (index % SIDE, index / SIDE);
        (x, y) != (0, 0) && libm::hypot(cycles(x), cycles(y)) < BAND
    });
    let (sum, count) = low.fold((0.0, 0_u32), |(sum, count), (_, power)| (sum + power, count + 1));
    Ok(sum / f64::from(count) / (alpha * (1.0 - alpha)))
}

/// The mean of values, and its standard error.
fn mean_and_error(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
    (mean, (squares / (n * (n - 1.0))).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Precision;
    use crate::threshold::two_scale::Variant;

    fn hashed([x, y]: [i64; 2]) -> f64 {
        seed::uniform01(&mut seed::rng("grain.test", (x as u64) << 32 ^ (y as u64 & 0xffff_ffff)))
    }

    /// A hash of each pixel has a grain of 1, blocks of four pixels nearly their number, and pairs of a value and its rest two thirds at an
    /// alpha of 1/4, where never both are visible.
    #[test]
    fn noise_without_order_has_a_grain_of_one() {
        let of = |threshold: fn([i64; 2]) -> f64| {
            let subject = Subject::of_fragments("test", Precision::F64, Variant::Isotropic, move |at| {
                Some(threshold([at.pixel.x.floor() as i64, at.pixel.y.floor() as i64]))
            });
            grain(&subject, 0).expect("thresholds")[1]
        };
        let white = of(hashed);
        assert!((white.grain - 1.0).abs() < 5.0 * white.error, "{white:?}");
        let blocks = of(|[x, y]| hashed([x >> 1, y >> 1]));
        assert!((3.4..4.0).contains(&blocks.grain), "{blocks:?}");
        let of_rests = of(|[x, y]| {
            let of_pair = hashed([x >> 1, y]);
            if x & 1 == 0 { of_pair } else { 1.0 - of_pair }
        });
        assert!((of_rests.grain - 2.0 / 3.0).abs() < 5.0 * of_rests.error, "{of_rests:?}");
    }
}
