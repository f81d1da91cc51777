//! How a threshold answers to the camera: how many points appear or vanish at once, and how long what is visible is on the screen.
//!
//! Octaves follow the derivatives, and derivatives follow the camera. Where one passes through many octaves in a small motion, or where
//! many points change their octave in the same moment, a surface *pops*: [`pops`] looks for the worst place. [`runs`] tells how long the
//! noise is along both screen axes of a surface at a grazing angle. Numbers and no claims, since no law says how much there should be. Not
//! in the paper, which says of the anisotropic variant that it is for such angles (§6), and shows pictures.

use crate::check::Subject;
use crate::check::grain::{MOTION, OCTAVE, values};
use crate::check::input::patch::{Patch, Start, rotation};
use crate::check::input::placement;
use crate::check::tolerance::WIDE;
use crate::scene::Fragment;
use crate::stats::seed;
use crate::threshold::footprint::Footprint;
use core::f64::consts::FRAC_PI_2;
use glam::{DMat3, DVec2, DVec3, dvec2};
use rand::rngs::Xoshiro256PlusPlus;

/// The alpha at which visibility is looked at: more than at any other may change.
pub const ALPHA: f64 = 0.5;

/// Points of a surface that are looked at together: a share of 5 in 100 has a standard error of 1 in 300.
pub const POINTS: usize = 1 << 12;

/// How many views are tried: a third of them on axis planes, a third in general position, a third nearly along an axis plane.
pub const VIEWS: usize = 192;

/// How far a motion goes: so many of them are an octave, or a quarter of a turn.
pub const STEPS: f64 = 64.0;

/// The greatest angle between the direction of view and the normal of the surface, in degrees: there a pixel is 3.9 times as long as wide.
/// At any angle up to a right one no bound could hold: a tilt by a fixed angle then goes through any number of octaves of the derivative.
pub const LARGEST_TILT: f64 = 75.0;

/// Up to so many pixels apart are the points of a surface.
const EXTENT: f64 = 1024.0;

/// How the camera moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// It comes closer by 1/64 of an octave.
    Zoom,
    /// It turns about its own axis by 1/64 of a quarter turn.
    Roll,
    /// It goes around the normal of the surface by as much.
    Orbit,
    /// It goes towards the surface by as much.
    Tilt,
}

impl Motion {
    /// Every motion.
    pub const ALL: [Self; 4] = [Self::Zoom, Self::Roll, Self::Orbit, Self::Tilt];

    /// The words in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Zoom => "zoom",
            Self::Roll => "roll",
            Self::Orbit => "orbit",
            Self::Tilt => "tilt",
        }
    }
}

/// How a surface lies in the object, and how it is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Two directions along the surface and its normal, orthonormal.
    pub surface: DMat3,
    /// Object units a pixel across the direction of view, as a power of two.
    pub octave: f64,
    /// The camera's turn about its own axis, in radians.
    pub roll: f64,
    /// The direction along the surface in which the camera looks, in radians from the first of the two directions.
    pub orbit: f64,
    /// The angle between the direction of view and the normal, in radians.
    pub tilt: f64,
}

impl View {
    fn draw(view: usize, rng: &mut Xoshiro256PlusPlus) -> Self {
        let turn = rotation(rng);
        let axis = view / 3 % 3;
        let along =
            DMat3::from_cols(DVec3::AXES[axis], DVec3::AXES[(axis + 1) % 3], DVec3::AXES[(axis + 2) % 3]);
        let surface = match view % 3 {
            0 => along,
            1 => turn,
            _ => {
                // Between a half and a sixty-fourth of a right angle away from an axis plane.
                let angle = FRAC_PI_2 * libm::exp2(-1.0 - 5.0 * seed::uniform01(rng));
                DMat3::from_axis_angle((turn.x_axis * (DVec3::ONE - along.z_axis)).normalize(), angle) * along
            }
        };
        let mut quarter = || FRAC_PI_2 * seed::uniform01(rng);
        let (roll, orbit) = (2.0 * quarter(), 2.0 * quarter());
        let largest = LARGEST_TILT.to_radians() - FRAC_PI_2 / STEPS;
        Self {
            surface,
            octave: OCTAVE + seed::uniform01(rng),
            roll,
            orbit,
            tilt: largest * seed::uniform01(rng),
        }
    }

    /// The same after a motion.
    #[must_use]
    pub fn after(&self, motion: Motion) -> Self {
        let angle = FRAC_PI_2 / STEPS;
        match motion {
            Motion::Zoom => Self { octave: self.octave - 1.0 / STEPS, ..*self },
            Motion::Roll => Self { roll: self.roll + angle, ..*self },
            Motion::Orbit => Self { orbit: self.orbit + angle, ..*self },
            Motion::Tilt => Self { tilt: self.tilt + angle, ..*self },
        }
    }

    /// The derivatives of the position along screen x and y, in object units a pixel.
    #[must_use]
    pub fn derivatives(&self) -> [DVec3; 2] {
        let pixel = libm::exp2(self.octave);
        let (sin, cos) = (libm::sin(self.orbit), libm::cos(self.orbit));
        let across = self.surface.x_axis * cos + self.surface.y_axis * sin;
        let along = (self.surface.y_axis * cos - self.surface.x_axis * sin) / libm::cos(self.tilt);
        let (sin, cos) = (libm::sin(self.roll), libm::cos(self.roll));
        [(across * cos + along * sin) * pixel, (along * cos - across * sin) * pixel]
    }
}

/// What one motion changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pops {
    /// The motion.
    pub motion: Motion,
    /// Share of a surface's points that appear or vanish, on average over views.
    pub mean: f64,
    /// The greatest share.
    pub worst: f64,
    /// The view where that was seen.
    pub at: View,
}

/// Measures what each of [`Motion::ALL`] changes at [`ALPHA`], in that order: derivatives follow the camera, the points keep their position, pixel
/// and texture coordinate. Of one seed always the same.
///
/// # Errors
///
/// In words, where the subject has no threshold in (0, 1] of a fragment.
pub fn pops(subject: &Subject<'_>, seed: u64) -> Result<Vec<Pops>, String> {
    let mut rng = seed::rng("motion.pops", seed);
    let views: Vec<View> = (0..VIEWS).map(|view| View::draw(view, &mut rng)).collect();
    let mut shares = [(); Motion::ALL.len()].map(|()| Vec::with_capacity(VIEWS));
    for view in &views {
        let origin = placement(&mut rng) * WIDE;
        let pixel = libm::exp2(view.octave) / subject.hash_scale;
        let places: Vec<(Start, DVec3)> = (0..POINTS)
            .map(|_| {
                let mut coordinate = || (seed::uniform01(&mut rng) - 0.5) * EXTENT * pixel;
                let place = origin + view.surface.x_axis * coordinate() + view.surface.y_axis * coordinate();
                (Start::draw(&mut rng), place)
            })
            .collect();
        let visible = |view: &View| -> Result<Vec<bool>, String> {
            let [dpdx, dpdy] = view.derivatives().map(|derivative| derivative / subject.hash_scale);
            let seen = |&(start, position): &(Start, DVec3)| {
                start.seeing(subject.precision.round(&Footprint { position, dpdx, dpdy }))
            };
            let fragments: Vec<Fragment> = places.iter().map(seen).collect();
            Ok(values(subject, &fragments)?.into_iter().map(|value| value <= ALPHA).collect())
        };
        let before = visible(view)?;
        for (shares, motion) in shares.iter_mut().zip(Motion::ALL) {
            let after = visible(&view.after(motion))?;
            let changed = before.iter().zip(&after).filter(|(before, after)| before != after).count();
            shares.push(changed as f64 / POINTS as f64);
        }
    }
    let of = |(motion, shares): (Motion, &Vec<f64>)| {
        let worst = (0..VIEWS).max_by(|&a, &b| shares[a].total_cmp(&shares[b])).unwrap_or(0);
        let mean = shares.iter().sum::<f64>() / VIEWS as f64;
        Pops { motion, mean, worst: shares[worst], at: views[worst] }
    };
    Ok(Motion::ALL.into_iter().zip(&shares).map(of).collect())
}

/// How long what is visible is on the screen, and how much of it a small motion changes, at one angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Runs {
    /// How many times a pixel is as long as wide.
    pub stretch: f64,
    /// Pixels in a row that are alike, across the direction of view and along it, in which the surface is foreshortened: 2 for pixels
    /// that know nothing of each other.
    pub lengths: [f64; 2],
    /// Shares of pixels that appear or vanish in [`MOTION`] across the direction of view and along it.
    pub flips: [f64; 2],
}

/// At which stretches [`runs`] looks: seen from the front, and at 60, 76 and 83 degrees.
pub const STRETCHES: [f64; 4] = [1.0, 2.0, 4.0, 8.0];

/// Pictures at each stretch.
const PICTURES: usize = 24;

/// Pixels along each side of one.
const SIDE: usize = 128;

/// Measures how long runs of pixels are that are all visible or all invisible at [`ALPHA`], and what a small motion changes, at
/// [`STRETCHES`], in that order, on surfaces in any direction. Of one seed always the same.
///
/// # Errors
///
/// As [`pops`].
pub fn runs(subject: &Subject<'_>, seed: u64) -> Result<Vec<Runs>, String> {
    let mut rng = seed::rng("motion.runs", seed);
    let mut of = |stretch: f64| {
        let (mut changes, mut flips) = ([0_usize; 2], [0_usize; 2]);
        for picture in 0..PICTURES {
            let turn = rotation(&mut rng);
            let pixel = libm::exp2(OCTAVE + picture as f64 / PICTURES as f64) / subject.hash_scale;
            let drawn = Footprint {
                position: DVec3::ZERO,
                dpdx: turn.x_axis * (pixel / stretch),
                dpdy: turn.y_axis * pixel,
            };
            let Footprint { dpdx, dpdy, .. } = subject.precision.round(&drawn);
            let (patch, start) = (Patch { dpdx, dpdy }, Start::draw(&mut rng));
            let visible = |moved: DVec2| -> Result<Vec<bool>, String> {
                let places = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| dvec2(x as f64, y as f64)));
                let fragments: Vec<Fragment> =
                    places.map(|place| patch.fragment(subject, &start, place + moved)).collect();
                Ok(values(subject, &fragments)?.into_iter().map(|value| value <= ALPHA).collect())
            };
            let before = visible(DVec2::ZERO)?;
            let rows = || before.chunks_exact(SIDE);
            changes[0] += rows().flat_map(|row| row.windows(2)).filter(|pair| pair[0] != pair[1]).count();
            changes[1] += before.iter().zip(&before[SIDE..]).filter(|(one, next)| one != next).count();
            for (flips, axis) in flips.iter_mut().zip(DVec2::AXES) {
                let after = visible(axis * MOTION)?;
                *flips += before.iter().zip(&after).filter(|(before, after)| before != after).count();
            }
        }
        let (pixels, pairs) = (PICTURES * SIDE * SIDE, PICTURES * SIDE * (SIDE - 1));
        Ok(Runs {
            stretch,
            lengths: changes.map(|changes| pairs as f64 / changes as f64),
            flips: flips.map(|flips| flips as f64 / pixels as f64),
        })
    };
    STRETCHES.into_iter().map(&mut of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::Precision;
    use crate::threshold::robust::{Join, Robust};
    use crate::threshold::two_scale::Variant;

    /// A view from the front has derivatives of one length, and one at 60 degrees a second one twice as long, whatever the roll.
    #[test]
    fn derivatives_are_those_of_a_tilted_surface() {
        let view = View {
            surface: DMat3::IDENTITY,
            octave: 0.0,
            roll: 0.0,
            orbit: 0.3,
            tilt: FRAC_PI_2 * 2.0 / 3.0,
        };
        let [dpdx, dpdy] = view.derivatives();
        assert!((dpdx.length() - 1.0).abs() < 1e-12 && (dpdy.length() - 2.0).abs() < 1e-12);
        let area = |[x, y]: [DVec3; 2]| x.cross(y).length();
        let rolled = View { roll: 1.1, ..view };
        assert!((area(view.derivatives()) - area(rolled.derivatives())).abs() < 1e-12);
        assert!(
            (view.after(Motion::Zoom).derivatives()[0].length() - libm::exp2(-1.0 / STEPS)).abs() < 1e-12
        );
    }

    /// A threshold of the place alone never pops and has runs by its cells; one that reads the derivatives does, wherever it is looked at.
    #[test]
    fn what_reads_the_derivatives_pops() {
        fn hashed_of(x: f32) -> f32 {
            (x.to_bits().wrapping_mul(0x9e37_79b1) >> 8) as f32 / 16_777_216.0 + 1e-8
        }
        let of = |threshold: fn(&Footprint<f32>) -> f32| {
            pops(&Subject::of_f32("test", Variant::Isotropic, threshold), 0).expect("thresholds")
        };
        let still = of(|at| hashed_of(at.position.x));
        assert!(still.iter().all(|pops| pops.worst == 0.0), "{still:?}");
        let shaky = of(|at| hashed_of(at.position.x + at.dpdx.x + at.dpdy.y));
        assert!(shaky.iter().all(|pops| pops.mean > 0.3), "{shaky:?}");
    }

    /// An octave of zoom changes half of the points of the dithered join, each at its own time; around the normal nothing changes but by rounding.
    #[test]
    fn one_scale_changes_a_little_at_a_time() {
        let robust = Robust { join: Join::Dithered, ..Robust::new(Variant::Isotropic) };
        let found = pops(&Subject::robust("robust", Precision::F32, robust), 0).expect("thresholds");
        for Pops { motion, mean, worst, .. } in found {
            let is_still = motion == Motion::Orbit;
            assert!(
                worst < if is_still { 1e-3 } else { 0.1 } && (is_still || mean > 1e-4),
                "{motion:?}: {mean} {worst}"
            );
        }
    }
}
