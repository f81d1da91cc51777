//! Hashes that look random and are not.

use super::defect::Specimen;
use super::port::{Port, SOUND, ideal_hash};
use crate::check::Subject;
use crate::check::subject::Precision;
use crate::threshold::emulated::{Emulated, Half};
use crate::threshold::footprint::Footprint;
use crate::threshold::hash::HashKind;
use crate::threshold::hash::open_lattice;
use crate::threshold::real::Real;
use crate::threshold::robust::Robust;
use crate::threshold::two_scale::Variant;

/// Listing 1 with another hash.
const fn hashed_by(hash: fn([f64; 3], i32) -> f64) -> Port {
    Port { hash, ..SOUND }
}

/// The four words that an integer hash reads.
fn words([x, y, z]: [f64; 3], octave: i32) -> [u32; 4] {
    [x.to_word(), y.to_word(), z.to_word(), octave as u32]
}

/// The words times one odd number each.
fn products(index: [f64; 3], octave: i32) -> [u32; 4] {
    let [x, y, z, w] = words(index, octave);
    [
        x.wrapping_mul(73_856_093),
        y.wrapping_mul(19_349_663),
        z.wrapping_mul(83_492_791),
        w.wrapping_mul(2_654_435_761),
    ]
}

/// One round of a generator that only shifts and adds without carry.
fn xorshift(mut word: u32) -> u32 {
    word ^= word << 13;
    word ^= word >> 17;
    word ^ (word << 5)
}

/// A linear form in the coordinates, as everybody copies it.
fn dot([x, y, z]: [f64; 3]) -> f64 {
    12.9898 * x + 78.233 * y + 37.719 * z
}

fn fraction(value: f64) -> f64 {
    value - value.floor()
}

pub(super) const FAMILY: &[Specimen] = &[
    Specimen {
        name: "congruential-hash",
        defect: "the hash is a linear congruence of the coordinates, so neighbours differ by a constant",
        mend: "use a hash that mixes all bits, as murmur3 or pcg4d",
        claim: "independence.neighbours",
        subject: || {
            hashed_by(|index, octave| {
                let sum = products(index, octave)
                    .iter()
                    .fold(1_013_904_223_u32, |sum, &word| sum.wrapping_add(word));
                open_lattice(sum)
            })
            .subject()
        },
    },
    Specimen {
        name: "xor-of-products",
        defect: "each coordinate is multiplied by a prime and the products are joined by exclusive or, as for a hash table",
        mend: "use a hash that mixes all bits, as murmur3 or pcg4d",
        claim: "independence.neighbours",
        subject: || {
            hashed_by(|index, octave| {
                open_lattice(products(index, octave).iter().fold(0, |all, word| all ^ word))
            })
            .subject()
        },
    },
    Specimen {
        name: "one-round-of-xorshift",
        defect: "one round of xorshift follows the coordinates, shifted and joined, without the octave: it is linear, and \
                 neighbours differ in fixed bits",
        mend: "use a hash that mixes all bits, as murmur3 or pcg4d",
        claim: "independence.neighbours",
        subject: || {
            hashed_by(|index, octave| {
                let [x, y, z, _] = words(index, octave);
                open_lattice(xorshift(x ^ y.rotate_left(8) ^ z.rotate_left(16)))
            })
            .subject()
        },
    },
    Specimen {
        name: "golden-ratio-sequence",
        defect: "the hash is a low-discrepancy sequence along each axis: too even, and neighbours differ by a constant",
        mend: "use a hash that mixes all bits, as murmur3 or pcg4d",
        claim: "hash.differences",
        subject: || {
            hashed_by(|[x, y, z], octave| {
                fraction(0.819_172_5 * x + 0.671_043_6 * y + 0.549_700_5 * z + 0.618_034 * f64::from(octave))
            })
            .subject()
        },
    },
    Specimen {
        name: "fract-sin-dot",
        defect: "the hash is fract(43758.5453 sin(dot)), which is odd: opposite cells add up to 1, and it reads no octave",
        mend: "use an integer hash over the cell and its octave",
        claim: "cells.mirror",
        subject: || hashed_by(|index, _| fraction(43_758.545_3 * libm::sin(dot(index)))).subject(),
    },
    Specimen {
        name: "sine-times-ten",
        defect: "the factor of the sine is so small that the law of the sine shows through the fraction",
        mend: "multiply the sine by 1e4 or more, or use an integer hash",
        claim: "uniform.marginal",
        subject: || {
            hashed_by(|index, octave| fraction(10.0 * libm::sin(dot(index) + 91.3458 * f64::from(octave))))
                .subject()
        },
    },
    Specimen {
        name: "paper-sine-in-f32",
        defect: "the paper's hash3D in 32 bits knows about 4000 values of x and y, and reads no octave",
        mend: "use an integer hash over the cell and its octave",
        claim: "layers.parallel",
        subject: || {
            let robust = Robust { hash: HashKind::Sine, ..Robust::new(Variant::Isotropic) };
            Subject::robust("specimen", Precision::F32, robust)
        },
    },
    Specimen {
        name: "half-precision",
        defect: "everything is computed in 16 bits, where coordinates have three digits and the hash a few values",
        mend: "compute cells and hash in 32 bits (highp)",
        claim: "uniform.marginal",
        subject: || {
            let half = |found: &Footprint<f64>| {
                let robust = Robust { hash: HashKind::Sine, ..Robust::new(Variant::Isotropic) };
                Some(robust.threshold::<Emulated<Half>>(&found.cast()).ok()?.to_f64())
            };
            let mut subject = Subject::new("specimen", Precision::F32, Variant::Isotropic, half);
            subject.nested_phase = true;
            subject
        },
    },
    Specimen {
        name: "eight-bit-hash",
        defect: "the hash has 8 bits, as a texture of noise has: one cell in 256 has a threshold of zero",
        mend: "use at least 16 bits of the hash, and a value in the middle of each step",
        claim: "atoms.zero",
        subject: || hashed_by(|index, octave| (256.0 * ideal_hash(index, octave)).floor() / 255.0).subject(),
    },
    Specimen {
        name: "eight-bit-hash-centred",
        defect: "the hash has 8 bits, so only 256 alphas can be told apart and the ends of the range are never drawn",
        mend: "use at least 16 bits of the hash",
        claim: "hash.values",
        subject: || {
            hashed_by(|index, octave| ((256.0 * ideal_hash(index, octave)).floor() + 0.5) / 256.0).subject()
        },
    },
    Specimen {
        name: "eleven-bit-hash",
        defect: "the hash has 11 bits and can be 0, as a half-precision texture",
        mend: "use at least 16 bits of the hash, and a value in the middle of each step",
        claim: "atoms.zero",
        subject: || {
            hashed_by(|index, octave| (2048.0 * ideal_hash(index, octave)).floor() / 2048.0).subject()
        },
    },
    Specimen {
        name: "sign-bit-masked",
        defect: "the sign bit of the hash is masked and the rest divided by 2^32, so no threshold is above a half",
        mend: "divide by the number of values that are left",
        claim: "uniform.marginal",
        subject: || hashed_by(|index, octave| 0.5 * ideal_hash(index, octave)).subject(),
    },
    Specimen {
        name: "signed-hash",
        defect: "the hash is taken for a signed number, so half of the thresholds are not above zero",
        mend: "convert the hash from an unsigned integer",
        claim: "range",
        subject: || {
            Port { hash: |index, octave| 2.0 * ideal_hash(index, octave) - 1.0, clamp: |t| t, ..SOUND }
                .subject()
        },
    },
    Specimen {
        name: "mean-of-three-hashes",
        defect: "each coordinate has a hash of its own and their mean is taken, which is no longer uniform",
        mend: "hash all three coordinates together",
        claim: "uniform.coverage",
        subject: || {
            hashed_by(|[x, y, z], octave| {
                let hashes =
                    [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]].map(|index| ideal_hash(index, octave));
                hashes.iter().sum::<f64>() / 3.0
            })
            .subject()
        },
    },
    Specimen {
        name: "sum-of-three-hashes",
        defect: "each coordinate has a hash of its own and the fraction of their sum is taken: rows are shifted copies of each other",
        mend: "hash all three coordinates together",
        claim: "layers.parallel",
        subject: || {
            hashed_by(|[x, y, z], octave| {
                let hashes =
                    [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]].map(|index| ideal_hash(index, octave));
                fraction(hashes.iter().sum())
            })
            .subject()
        },
    },
];
