//! What stages are put together of.

use super::super::Class;
use crate::threshold::cdf::CdfForm;
use crate::threshold::hash::HashKind;
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::pipeline::Pipeline;
use crate::threshold::robust::{Join, Robust};
use crate::threshold::two_scale::Variant;

pub(super) const fn bounded(ulp: f64, absolute: f64, source: &'static str) -> Class {
    Class::Bounded { ulp, absolute, source }
}

/// 2^-21, what `log2` may be off on [1/2, 2].
pub(super) const LOG2: f64 = 1.0 / 2_097_152.0;

/// Sums of the paper's kind on [0, 1]: a quotient of 2.5 ULP, the rest correctly rounded or fused.
pub(super) const EQ_2: Class =
    bounded(4.0, 4.0 / 16_777_216.0, "one or two quotients of 2.5 ULP, products that may be fused");

pub(super) fn listing(variant: Variant, hash: HashKind) -> Pipeline {
    Pipeline::listing(variant).with_hash(hash)
}

pub(super) fn isotropic() -> Pipeline {
    listing(Variant::Isotropic, HashKind::Mm4)
}

pub(super) fn anisotropic() -> Pipeline {
    listing(Variant::Anisotropic, HashKind::Mm4)
}

pub(super) fn stable() -> Pipeline {
    HashedAlpha { form: CdfForm::Stable, ..HashedAlpha::default().with_hash(HashKind::Mm4) }.into()
}

pub(super) fn robust(variant: Variant, join: Join) -> Pipeline {
    Robust { join, ..Robust::new(variant) }.into()
}

/// A stage whose expression is one number.
macro_rules! number_stage {
    ($name:literal, $class:expr, $pipeline:expr, $expression:literal, $words:literal, $input:expr,
     |$given:ident| $value:expr, [$right:literal, $wrong:literal]) => {
        Stage {
            name: $name,
            class: $class,
            pipeline: $pipeline,
            expression: concat!("array(bitcast<u32>(", $expression, "))"),
            words: [$words, 1],
            input: $input,
            reference: |$given, out| out.push($value),
            wrong: [$right, $wrong],
        }
    };
}

/// A stage whose expression is a vector of three numbers.
macro_rules! vector_stage {
    ($name:literal, $class:expr, $pipeline:expr, $expression:literal, $words:literal, $input:expr,
     |$given:ident| $value:expr, [$right:literal, $wrong:literal]) => {
        Stage {
            name: $name,
            class: $class,
            pipeline: $pipeline,
            expression: concat!("three(", $expression, ")"),
            words: [$words, 3],
            input: $input,
            reference: |$given, out| out.extend($value),
            wrong: [$right, $wrong],
        }
    };
}

pub(super) use {number_stage, vector_stage};
