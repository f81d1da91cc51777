//! Patches: surfaces whose derivatives are the same everywhere, as of a plane seen frontally or from far away.
//!
//! Closed forms for noise as a whole (its size, its spectrum, the variance of coverage) are about one set of octaves and
//! faces of cells at uniform places. A patch has both, whatever its direction.

use crate::check::Subject;
use crate::check::input::sample::placement;
use crate::check::tolerance::{PLACEMENT, WIDE};
use crate::scene::Fragment;
use crate::stats::seed::uniform01;
use crate::threshold::footprint::Footprint;
use core::f64::consts::TAU;
use glam::{DMat3, DQuat, DVec2, DVec3, dvec2};
use rand::rngs::Xoshiro256PlusPlus;

/// Derivatives of a patch times its hash scale lie in the octave from this one on: coarse cells of 2^-5 units, a
/// thousandth of a cell being five roundings of an `f32` position within [`WIDE`] times [`PLACEMENT`].
const PATCH_OCTAVES: f64 = -6.0;

/// No object axis of a patch has less than this share of the largest derivative: twice the share to which the robust
/// threshold raises it.
const LEAST_AXIS_SHARE: f64 = 1.0 / 16.0;

/// Pixels along each side of the screen on which patches are seen.
const SCREEN: f64 = 1024.0;

/// The derivatives of a patch, exact in the precision of the subject it was drawn for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Object units per pixel along screen x.
    pub dpdx: DVec3,
    /// Object units per pixel along screen y.
    pub dpdy: DVec3,
}

impl Patch {
    /// Draws a patch in general position: every direction alike, every place between two octaves alike.
    ///
    /// The derivative along screen x is `stretch` times as long as that along y; 1 is a patch that is seen frontally. No
    /// object axis is nearly without derivative, since there a listing and its robust form part.
    pub fn draw(subject: &Subject<'_>, stretch: f64, rng: &mut Xoshiro256PlusPlus) -> Self {
        loop {
            let turn = rotation(rng);
            let longest = libm::exp2(PATCH_OCTAVES + uniform01(rng)) / subject.hash_scale;
            let [along_x, along_y] = if stretch > 1.0 { [1.0, 1.0 / stretch] } else { [stretch, 1.0] };
            let drawn = Footprint {
                position: DVec3::ZERO,
                dpdx: turn.x_axis * (longest * along_x),
                dpdy: turn.y_axis * (longest * along_y),
            };
            let Footprint { dpdx, dpdy, .. } = subject.precision.round(&drawn);
            let largest = dpdx.abs().max(dpdy.abs());
            if largest.min_element() > LEAST_AXIS_SHARE * largest.max_element() {
                return Self { dpdx, dpdy };
            }
        }
    }

    /// Returns the footprint of the patch where its object is at its own origin: what its octaves follow from.
    #[must_use]
    pub const fn footprint(&self) -> Footprint<f64> {
        Footprint { position: DVec3::ZERO, dpdx: self.dpdx, dpdy: self.dpdy }
    }

    /// Returns how far two pixels are apart in object units.
    #[must_use]
    pub fn lag(&self, pixels: DVec2) -> DVec3 {
        self.dpdx * pixels.x + self.dpdy * pixels.y
    }

    /// Returns the fragment `place` pixels away from where the patch begins.
    #[must_use]
    pub fn fragment(&self, subject: &Subject<'_>, start: &Start, place: DVec2) -> Fragment {
        let lag = self.lag(place);
        let lengths = dvec2(self.dpdx.length(), self.dpdy.length());
        // A pixel is as long as the shorter derivative; the longer one goes into the depth too.
        let pixel = lengths.min_element();
        let slopes = (lengths * lengths - pixel * pixel).map(|square| square.max(0.0).sqrt());
        let position = start.object + lag;
        Fragment {
            world: start.world + lag,
            eye: start.eye + (place * pixel).extend(place.dot(slopes)),
            pixel: start.pixel + place,
            texcoord: start.texcoord + place * lengths / (2.0 * PLACEMENT),
            ..start.seeing(subject.precision.round(&Footprint { position, ..self.footprint() }))
        }
    }

    /// Returns the fragments of an image of the patch, row by row and `spacing` pixels apart, at a place of its own.
    pub fn image(
        &self,
        subject: &Subject<'_>,
        [width, height]: [usize; 2],
        spacing: f64,
        rng: &mut Xoshiro256PlusPlus,
    ) -> Vec<Fragment> {
        let start = Start::draw(rng);
        let places = (0..height).flat_map(|y| (0..width).map(move |x| dvec2(x as f64, y as f64) * spacing));
        places.map(|place| self.fragment(subject, &start, place)).collect()
    }
}

/// Levels of detail among which that of a place is drawn: a texture of 64 texels, magnified or not.
const LEVELS: [f64; 2] = [-1.0, 6.0];

/// Layers among which that of a place is drawn.
const LAYERS: f64 = 4.0;

/// Where something is seen, in every coordinate that a subject may hash besides that of the object.
///
/// A claim that makes footprints by itself draws a place for each, or for each point that it follows: otherwise noise that is
/// locked to the screen, or that reads a level or a layer, would be looked at in one pixel only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    object: DVec3,
    world: DVec3,
    eye: DVec3,
    pixel: DVec2,
    texcoord: DVec2,
    lod: f64,
    layer: u32,
}

impl Start {
    /// Draws a place in each of the coordinates.
    pub fn draw(rng: &mut Xoshiro256PlusPlus) -> Self {
        let [object, world, eye] = [(); 3].map(|()| placement(rng) * WIDE);
        let mut pixel = || (uniform01(rng) * SCREEN).floor() + 0.5;
        let pixel = dvec2(pixel(), pixel());
        let texcoord = dvec2(uniform01(rng), uniform01(rng));
        let [finest, coarsest] = LEVELS;
        let lod = finest + (coarsest - finest) * uniform01(rng);
        let layer = (uniform01(rng) * LAYERS) as u32;
        Self { object, world, eye, pixel, texcoord, lod, layer }
    }

    /// Returns the fragment of a footprint that is seen here: world and eye are as far from where they are at the object's
    /// origin as the position is from it.
    #[must_use]
    pub fn seeing(&self, footprint: Footprint<f64>) -> Fragment {
        Fragment {
            footprint,
            world: self.world + footprint.position,
            eye: self.eye + footprint.position,
            pixel: self.pixel,
            texcoord: self.texcoord,
            lod: self.lod,
            frame: 0,
            layer: self.layer,
        }
    }
}

/// Draws a rotation; all are equally likely.
pub fn rotation(rng: &mut Xoshiro256PlusPlus) -> DMat3 {
    // Shoemake's uniform quaternions.
    let radius = uniform01(rng);
    let [first, second] = [(); 2].map(|()| TAU * uniform01(rng));
    let (inner, outer) = ((1.0 - radius).sqrt(), radius.sqrt());
    DMat3::from_quat(DQuat::from_xyzw(
        inner * libm::sin(first),
        inner * libm::cos(first),
        outer * libm::sin(second),
        outer * libm::cos(second),
    ))
}
