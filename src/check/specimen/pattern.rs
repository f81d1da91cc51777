//! Patterns of dithering in the place of a hash: even at a glance, and the same everywhere.

use super::defect::Specimen;
use super::port::{Port, SOUND, ideal_hash};
use crate::check::Subject;
use crate::check::subject::Precision;
use crate::scene::Fragment;
use crate::threshold::two_scale::Variant;

/// Listing 1 with a pattern for the hash.
const fn patterned(hash: fn([f64; 3], i32) -> f64) -> Port {
    Port { hash, ..SOUND }
}

/// The place of a cell in the 8 x 8 matrix of Bayer, 0 to 63.
fn bayer(x: f64, y: f64) -> f64 {
    let (x, y) = (x.rem_euclid(8.0) as u32, y.rem_euclid(8.0) as u32);
    let bits = (0..3).map(|bit| {
        let (x, y) = (x >> bit & 1, y >> bit & 1);
        ((x ^ y) << 1 | y) << (4 - 2 * bit)
    });
    f64::from(bits.sum::<u32>())
}

fn fraction(value: f64) -> f64 {
    value - value.floor()
}

/// A bijection of 0 to 255, as the table of Perlin's noise.
fn permuted(index: f64) -> f64 {
    let mut byte = index.rem_euclid(256.0) as u8;
    for _ in 0..3 {
        byte = byte.wrapping_mul(167).wrapping_add(13);
        byte ^= byte >> 3;
    }
    f64::from(byte)
}

pub(super) const FAMILY: &[Specimen] = &[
    Specimen {
        name: "bayer-matrix",
        defect: "the threshold comes from an 8 x 8 matrix of ordered dither over the cells: 64 values, in a visible pattern",
        mend: "hash the cell",
        claim: "independence.neighbours",
        subject: || patterned(|[x, y, _], _| (bayer(x, y) + 0.5) / 64.0).subject(),
    },
    Specimen {
        name: "jittered-bayer-matrix",
        defect: "a hash only jitters within the steps of an ordered dither: neighbours repel each other",
        mend: "hash the cell",
        claim: "independence.neighbours",
        subject: || {
            patterned(|[x, y, z], octave| (bayer(x, y) + ideal_hash([x, y, z], octave)) / 64.0).subject()
        },
    },
    Specimen {
        name: "interleaved-gradient-noise",
        defect: "Jimenez' interleaved gradient noise over the cells stands in for the hash: a gradient with jumps",
        mend: "hash the cell",
        claim: "independence.neighbours",
        subject: || {
            patterned(|[x, y, z], _| {
                fraction(52.982_918_9 * fraction(0.067_110_56 * x + 0.005_837_15 * y + 0.003_145_7 * z))
            })
            .subject()
        },
    },
    Specimen {
        name: "noise-texture",
        defect: "a texture of 64 x 64 random numbers is tiled over the cells: each plane has its few values and their bias",
        mend: "hash the cell",
        claim: "uniform.constant_z",
        subject: || {
            patterned(|[x, y, z], octave| ideal_hash([x.rem_euclid(64.0), y.rem_euclid(64.0), z], octave))
                .subject()
        },
    },
    Specimen {
        name: "permutation-table",
        defect: "a table of 256 bytes is looked up once a coordinate, as in Perlin's noise: 8 bits, with a period of 256 cells",
        mend: "hash the cell",
        claim: "atoms.zero",
        subject: || {
            patterned(|[x, y, z], octave| {
                permuted(permuted(permuted(permuted(f64::from(octave)) + z) + y) + x) / 255.0
            })
            .subject()
        },
    },
    Specimen {
        name: "shuffled-strata",
        defect: "the cells of every row of 16 have one threshold in each 16th of the range, as if coverage should be exact",
        mend: "hash every cell by itself",
        claim: "coverage.variance",
        subject: || {
            patterned(|[x, y, z], octave| {
                let (row, place) = ((x / 16.0).floor(), x.rem_euclid(16.0));
                let turn = (16.0 * ideal_hash([row, y, z], octave ^ 0x400)).floor();
                ((5.0 * place + turn).rem_euclid(16.0) + ideal_hash([x, y, z], octave)) / 16.0
            })
            .subject()
        },
    },
    Specimen {
        name: "tone-across-the-screen",
        defect: "a wave across the screen is added to the threshold and the fraction taken: uniform everywhere, with one \
                 frequency too strong",
        mend: "let the threshold depend on the object alone",
        claim: "spectrum.ordinates",
        subject: || {
            let sound = SOUND.subject();
            let humming = move |at: &Fragment| {
                let wave = 0.25 * libm::sin(core::f64::consts::TAU * 0.31 * at.pixel.x);
                Some(fraction(sound.threshold(*at)? + wave))
            };
            let mut subject = Subject::of_fragments("specimen", Precision::F64, Variant::Isotropic, humming);
            subject.nested_phase = true;
            subject
        },
    },
];
