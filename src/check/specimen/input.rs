//! Hashed from other coordinates than the object's.

use super::defect::Specimen;
use super::port::{Port, SOUND, ideal_hash};
use crate::check::Subject;
use crate::check::subject::Precision;
use crate::scene::Fragment;
use crate::threshold::footprint::Footprint;
use crate::threshold::two_scale::Variant;
use glam::DVec3;

/// Listing 1 at another position, with the derivatives as they are.
const fn reading(read: fn(&Fragment) -> Footprint<f64>) -> Port {
    Port { read, ..SOUND }
}

pub(super) const FAMILY: &[Specimen] = &[
    Specimen {
        name: "screen-space",
        defect: "the threshold is that of the pixel, so the noise stays on the screen while the object moves",
        mend: "hash the position in object coordinates",
        claim: "frames.serial",
        subject: || reading(|at| Footprint { position: at.pixel.extend(0.0), ..at.footprint }).subject(),
    },
    Specimen {
        name: "eye-space",
        defect: "the position in eye coordinates is hashed, so the object swims through its noise as the camera moves",
        mend: "hash the position in object coordinates",
        claim: "coordinates.object",
        subject: || reading(|at| Footprint { position: at.eye, ..at.footprint }).subject(),
    },
    Specimen {
        name: "world-space",
        defect: "the position in world coordinates is hashed, so a moving object swims through its noise",
        mend: "hash the position in object coordinates",
        claim: "flips.skinning",
        subject: || reading(|at| Footprint { position: at.world, ..at.footprint }).subject(),
    },
    Specimen {
        name: "texture-space",
        defect: "the threshold is that of the texture coordinates, so the noise is as coarse as the texture is stretched, and repeats with it",
        mend: "hash the position in object coordinates",
        claim: "uniform.marginal",
        subject: || reading(|at| Footprint { position: at.texcoord.extend(0.0), ..at.footprint }).subject(),
    },
    Specimen {
        name: "tiled-texture-of-noise",
        defect: "a texture of noise is repeated eight times over the texture coordinates, and has no mip levels",
        mend: "hash the position in object coordinates, in cells as large as a pixel",
        claim: "independence.octaves",
        subject: || {
            let texel = |at: &Fragment| {
                let tile = at.texcoord * 8.0;
                let [x, y] = ((tile - tile.floor()) * 1024.0).floor().to_array();
                ideal_hash([x, y, 0.0], 0)
            };
            Subject::of_fragments("specimen", Precision::F64, Variant::Isotropic, texel)
        },
    },
    Specimen {
        name: "one-threshold-an-object",
        defect: "a whole object has one threshold, so that all of it comes or goes at once",
        mend: "hash the cell of the position",
        claim: "uniform.coverage",
        subject: || reading(|at| Footprint { position: DVec3::ONE, ..at.footprint }).subject(),
    },
    Specimen {
        name: "mirrored-coordinates",
        defect: "the absolute value of each coordinate is hashed, so the noise is its own mirror image",
        mend: "keep the sign of the coordinates, as two's complement or as a bit of the hash",
        claim: "cells.mirror",
        subject: || {
            reading(|at| Footprint { position: at.footprint.position.abs(), ..at.footprint }).subject()
        },
    },
    Specimen {
        name: "noise-by-level-of-detail",
        defect: "from the fourth level of the texture on another noise is taken, so that thresholds are redrawn where a level begins",
        mend: "leave the level of detail out of the hash",
        claim: "determinism.arguments",
        subject: || {
            let read = |at: &Fragment| {
                let beside = if at.lod >= 4.0 { 0.31 } else { 0.0 };
                Footprint { position: at.footprint.position + beside, ..at.footprint }
            };
            reading(read).subject()
        },
    },
    Specimen {
        name: "other-noise-on-odd-pixels",
        defect: "every second column of the screen has another noise, as for a dissolve in a checkerboard, so that noise swims",
        mend: "leave the pixel out of the hash",
        claim: "determinism.arguments",
        subject: || {
            let read = |at: &Fragment| {
                let beside = if at.pixel.x.rem_euclid(2.0) >= 1.0 { 17.0 } else { 0.0 };
                Footprint { position: at.footprint.position + beside, ..at.footprint }
            };
            reading(read).subject()
        },
    },
];
