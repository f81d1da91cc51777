//! The table: every stage, what a device owes there, and an error that the comparison must see. One file a part of the
//! threshold.

use super::{Class, Stage};
use crate::shader::assemble::{ShaderOptions, Source};
use crate::threshold::cdf::CdfForm;
use crate::threshold::hash::HashKind;
use crate::threshold::robust::Join;
use crate::threshold::two_scale::Variant;

const fn bounded(ulp: f64, absolute: f64, source: &'static str) -> Class {
    Class::Bounded { ulp, absolute, source }
}

/// 2^-21, what `log2` may be off on [1/2, 2].
const LOG2: f64 = 1.0 / 2_097_152.0;

/// Sums of the paper's kind on [0, 1]: a quotient of 2.5 ULP, the rest correctly rounded or fused.
const EQ_2: Class =
    bounded(4.0, 4.0 / 16_777_216.0, "one or two quotients of 2.5 ULP, products that may be fused");

fn listing(variant: Variant, hash: HashKind) -> ShaderOptions {
    ShaderOptions { hash, ..ShaderOptions::listing(variant) }
}

fn isotropic() -> ShaderOptions {
    listing(Variant::Isotropic, HashKind::Mm4)
}

fn anisotropic() -> ShaderOptions {
    listing(Variant::Anisotropic, HashKind::Mm4)
}

fn stable() -> ShaderOptions {
    ShaderOptions { source: Source::Listing(CdfForm::Stable), ..isotropic() }
}

fn robust(variant: Variant, join: Join) -> ShaderOptions {
    ShaderOptions { source: Source::Robust(join), ..ShaderOptions::robust(variant) }
}

/// A stage whose expression is one number.
macro_rules! number_stage {
    ($name:literal, $class:expr, $options:expr, $expression:literal, $words:literal, $input:expr,
     |$given:ident| $value:expr, [$right:literal, $wrong:literal]) => {
        Stage {
            name: $name,
            class: $class,
            options: $options,
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
    ($name:literal, $class:expr, $options:expr, $expression:literal, $words:literal, $input:expr,
     |$given:ident| $value:expr, [$right:literal, $wrong:literal]) => {
        Stage {
            name: $name,
            class: $class,
            options: $options,
            expression: concat!("three(", $expression, ")"),
            words: [$words, 3],
            input: $input,
            reference: |$given, out| out.extend($value),
            wrong: [$right, $wrong],
        }
    };
}

mod effects;
mod hashes;
mod scales;
mod thresholds;
mod uniform;

/// Returns every stage, in the order of a threshold.
pub fn stages() -> impl Iterator<Item = &'static Stage> {
    [scales::STAGES, hashes::STAGES, uniform::STAGES, thresholds::STAGES, effects::STAGES]
        .into_iter()
        .flatten()
}
