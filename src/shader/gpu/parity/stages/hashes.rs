//! Hashes of a cell: of integers, and of the paper.

use super::super::input::{self, numbers};
use super::super::{Class, Stage};
use super::parts::listing;
use crate::threshold::hash::{self, Cell, Hash, HashKind};
use crate::threshold::two_scale::Variant;

fn hash_of(kind: HashKind, words: &[u32], out: &mut Vec<f32>) {
    out.push(kind.hash(&Cell { index: numbers(words, 0).into(), octave: words[3] }));
}

/// A stage for each hash of the list: bits of integers, the law of the paper's, near the origin, where its sine is that of
/// most devices.
macro_rules! hash_stages {
    ($($kind:ident = $file:ident, $doc:literal;)*) => {
        pub(super) const STAGES: &[Stage] = &[$(
            Stage {
                name: concat!("hash ", stringify!($file)),
                class: if hash::$file::ENTRY.is_exact { Class::Bits } else { Class::Law },
                pipeline: || listing(Variant::Isotropic, HashKind::$kind),
                expression: if hash::$file::ENTRY.reads_octave { WITH_OCTAVE } else { WITHOUT_OCTAVE },
                words: [4, 1],
                input: if hash::$file::ENTRY.is_exact { input::cell } else { input::near_cell },
                reference: |words, out| hash_of(HashKind::$kind, words, out),
                wrong: hash::$file::ENTRY.mistake,
            }
        ),*];
    };
}

const WITH_OCTAVE: &str =
    "array(bitcast<u32>(hash_cell(Cell(vec3<f32>(number(0u), number(1u), number(2u)), word(3u)))))";
const WITHOUT_OCTAVE: &str =
    "array(bitcast<u32>(hash_cell(Cell(vec3<f32>(number(0u), number(1u), number(2u))))))";

hash::hashes!(hash_stages);

/// The paper's hashes far from the origin.
pub(super) const FAR: &[Stage] = &[
    Stage { name: "hash sine, far cells", input: input::cell, ..STAGES[0] },
    Stage { name: "hash sine_chi_2, far cells", input: input::cell, ..STAGES[1] },
];
