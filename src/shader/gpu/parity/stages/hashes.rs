//! Hashes of a cell: of integers, and of the paper.

use super::super::input::{self, numbers};
use super::super::{Class, Stage};
use super::listing;
use crate::threshold::hash::{Cell, Hash, HashKind};
use crate::threshold::two_scale::Variant;

fn hash_of(kind: HashKind, words: &[u32], out: &mut Vec<f32>) {
    out.push(kind.hash(&Cell { index: numbers(words, 0).into(), octave: words[3] }));
}

/// A hash of integers, or of the paper.
macro_rules! hash_stage {
    ($name:literal, $kind:expr, $class:expr, $octave:literal, $input:expr, [$right:literal, $wrong:literal]) => {
        Stage {
            name: $name,
            class: $class,
            pipeline: || listing(Variant::Isotropic, $kind),
            expression: concat!(
                "array(bitcast<u32>(hash_cell(Cell(vec3<f32>(number(0u), number(1u), number(2u))",
                $octave,
                "))))"
            ),
            words: [4, 1],
            input: $input,
            reference: |words, out| hash_of($kind, words, out),
            wrong: [$right, $wrong],
        }
    };
}

#[rustfmt::skip]
pub(super) const STAGES: &[Stage] = &[
    hash_stage!("hash mm4", HashKind::Mm4, Class::Bits, ", word(3u)", input::cell, ["0x85ebca6bu", "0x85ebca6du"]),
    hash_stage!("hash xxhash32", HashKind::Xxhash32, Class::Bits, ", word(3u)", input::cell, ["668265263u", "668265265u"]),
    hash_stage!("hash pcg3d", HashKind::Pcg3d, Class::Bits, "", input::cell, ["v.z += v.x * v.y", "v.z += v.x"]),
    hash_stage!("hash pcg4d", HashKind::Pcg4d, Class::Bits, ", word(3u)", input::cell, ["v.w += v.y * v.z", "v.w += v.y"]),
    hash_stage!("hash pcg nested", HashKind::PcgNested, Class::Bits, ", word(3u)", input::cell, [">> 28u", ">> 27u"]),
    hash_stage!("hash sine", HashKind::Sine, Class::Law, "", input::near_cell, ["1.0e4", "1.0"]),
    hash_stage!("hash sine, far cells", HashKind::Sine, Class::Law, "", input::cell, ["1.0e4", "1.0"]),
    hash_stage!(
        "hash sine chi 2", HashKind::SineChi2, Class::Law, "", input::near_cell, ["floor(product)", "trunc(product)"]
    ),
    hash_stage!(
        "hash sine chi 2, far cells", HashKind::SineChi2, Class::Law, "", input::cell,
        ["floor(product)", "trunc(product)"]
    ),
];
