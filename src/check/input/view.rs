//! Views of a point that stays where it is: only its derivatives change.

use crate::stats::seed;
use glam::{DVec2, DVec3, dvec3};
use rand::rngs::Xoshiro256PlusPlus;

/// Octave from which the views of a sweep begin: cells of an eighth of a unit, of which [`PLACEMENT`] holds a million.
const FINEST_VIEW: f64 = 3.0;

/// Draws two tangents of one length, at right angles, in any direction.
pub(crate) fn tangents(rng: &mut Xoshiro256PlusPlus) -> [DVec3; 2] {
    let length = libm::exp2(-FINEST_VIEW - seed::uniform01(rng));
    let mut direction = || loop {
        let v = dvec3(seed::uniform01(rng), seed::uniform01(rng), seed::uniform01(rng)) * 2.0 - 1.0;
        if (0.01..1.0).contains(&v.length_squared()) {
            return v.normalize();
        }
    };
    let u = direction();
    loop {
        if let Some(v) = u.cross(direction()).try_normalize() {
            return [u * length, v * length];
        }
    }
}

/// The derivatives after the camera has come closer by so many octaves, from two tangents of equal length at right
/// angles.
pub(crate) fn zoomed([u, v]: [DVec3; 2], octaves: f64) -> [DVec3; 2] {
    let scale = libm::exp2(-octaves);
    [u * scale, v * scale]
}

/// The derivatives after a turn about the line of sight, by an angle in radians, of a surface at 60 degrees to the
/// screen, so that turning it changes the longer of the derivatives.
pub(crate) fn turned([u, v]: [DVec3; 2], angle: f64) -> [DVec3; 2] {
    let turn = DVec2::new(libm::cos(angle), libm::sin(angle));
    [u * turn.x + 2.0 * v * turn.y, 2.0 * v * turn.x - u * turn.y]
}

/// The derivatives after a tilt that stretches the second by so many octaves.
pub(crate) fn tilted([u, v]: [DVec3; 2], octaves: f64) -> [DVec3; 2] {
    [u, v * libm::exp2(octaves)]
}
