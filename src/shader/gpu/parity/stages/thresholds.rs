//! Whole thresholds: of the listings, and robust ones.

use super::super::input::{self, read_footprint};
use super::super::{Class, Stage};
use super::parts::{LOG2, anisotropic, bounded, isotropic, listing, robust};
use crate::threshold::cdf::CdfForm;
use crate::threshold::hash::HashKind;
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::robust::{Join, Robust};
use crate::threshold::two_scale::Variant;

/// In units of 2^-21, the lerp factor has the error of `log2` on the mantissa (1), of the quotient before it (0.9), of
/// the length before that (1.8) and of Rust's own rounding (0.1); a threshold has a slope of at most 2 over it, and Eq. 2
/// adds 0.5.
const ROBUST: Class = bounded(0.0, 8.1 * LOG2, "log2 2^-21 on [1, 2], quotients 2.5 ULP, sqrt 4.5 ULP");

/// As [`ROBUST`], with the logarithm of the whole scale, in [4, 16]: 3 ULP are 6 units.
const LISTING: Class = bounded(0.0, 19.0 * LOG2, "log2 3 ULP, quotients 2.5 ULP, sqrt 4.5 ULP");

/// As [`ROBUST`], with a slope of at most 6 over the lerp factor, and quantiles and their law good to 2 units more.
const COPULA: Class =
    bounded(0.0, 25.0 * LOG2, "log2 2^-21 on [1, 2], quotients 2.5 ULP, sqrt 4.5 ULP, polynomials 2^-20");

fn robust_threshold(variant: Variant, join: Join, words: &[u32], out: &mut Vec<f32>) {
    let robust = Robust { join, ..Robust::new(variant) };
    out.push(robust.threshold(&read_footprint(words)).unwrap_or(f32::NAN));
}

fn listing_threshold(variant: Variant, hash: HashKind, words: &[u32], out: &mut Vec<f32>) {
    let hashed = HashedAlpha { hash, variant, hash_scale: 1.0, form: CdfForm::Literal };
    out.push(hashed.threshold(&read_footprint(words)));
}

/// A whole threshold of nine numbers.
macro_rules! threshold_stage {
    ($name:literal, $class:expr, $pipeline:expr, $input:expr, $reference:expr, [$right:literal, $wrong:literal]) => {
        Stage {
            name: $name,
            class: $class,
            pipeline: $pipeline,
            expression: "array(bitcast<u32>(threshold(
    vec3<f32>(number(0u), number(1u), number(2u)),
    vec3<f32>(number(3u), number(4u), number(5u)),
    vec3<f32>(number(6u), number(7u), number(8u)),
)))",
            words: [9, 1],
            input: $input,
            reference: $reference,
            wrong: [$right, $wrong],
        }
    };
}

/// A whole robust threshold of [`input::nine`] numbers, or of those at which it does not jump.
macro_rules! robust_stage {
    ($name:literal, $class:expr, $variant:ident, $join:ident, nine, $wrong:tt) => {
        robust_stage!($name, $class, $variant, $join, (input::nine), $wrong)
    };
    ($name:literal, $class:expr, $variant:ident, $join:ident, steady, $wrong:tt) => {
        robust_stage!(
            $name,
            $class,
            $variant,
            $join,
            (|index, words| {
                input::steady_nine(index, words, &|given, out| {
                    robust_threshold(Variant::$variant, Join::$join, given, out);
                });
            }),
            $wrong
        )
    };
    ($name:literal, $class:expr, $variant:ident, $join:ident, ($input:expr), $wrong:tt) => {
        threshold_stage!(
            $name,
            $class,
            || robust(Variant::$variant, Join::$join),
            $input,
            |words, out| robust_threshold(Variant::$variant, Join::$join, words, out),
            $wrong
        )
    };
}

#[rustfmt::skip]
pub(super) const STAGES: &[Stage] = &[
    threshold_stage!(
        "threshold paper isotropic", Class::Law, || listing(Variant::Isotropic, HashKind::Sine), input::nine,
        |words, out| listing_threshold(Variant::Isotropic, HashKind::Sine, words, out),
        ["clamp(cdf(interpolated, scales.lerp_factor)", "clamp((interpolated)"]
    ),
    threshold_stage!(
        "threshold paper anisotropic", Class::Law, || listing(Variant::Anisotropic, HashKind::Sine), input::nine,
        |words, out| listing_threshold(Variant::Anisotropic, HashKind::Sine, words, out),
        ["clamp(cdf(interpolated, scales.lerp_factor)", "clamp((interpolated)"]
    ),
    threshold_stage!(
        "threshold listing 1, mm4", LISTING, isotropic, input::nine,
        |words, out| listing_threshold(Variant::Isotropic, HashKind::Mm4, words, out),
        ["clamp(cdf(interpolated, scales.lerp_factor)", "clamp((interpolated)"]
    ),
    threshold_stage!(
        "threshold listing 2, mm4", LISTING, anisotropic,
        |index, words| {
            input::steady_nine(index, words, &|given, out| {
                listing_threshold(Variant::Anisotropic, HashKind::Mm4, given, out);
            });
        },
        |words, out| listing_threshold(Variant::Anisotropic, HashKind::Mm4, words, out),
        ["0.707", "1.0"]
    ),
    robust_stage!(
        "threshold robust isotropic interpolate", ROBUST, Isotropic, Interpolate, nine, ["scaled - whole >= boundary", "scaled - whole > 1.0 - boundary"]
    ),
    robust_stage!(
        "threshold robust isotropic copula", COPULA, Isotropic, Copula, nine, ["weight * fine) / sqrt(", "weight * fine) * sqrt("]
    ),
    robust_stage!(
        "threshold robust isotropic dithered", Class::Bits, Isotropic, Dithered, steady, ["^ 0x6a09e667u", "^ 0x6a09e666u"]
    ),
    robust_stage!(
        "threshold robust anisotropic interpolate", ROBUST, Anisotropic, Interpolate, steady, ["let to_ceil = length_of(1.0 - fraction)", "let to_ceil = length_of(fraction)"]
    ),
    robust_stage!(
        "threshold robust anisotropic copula", COPULA, Anisotropic, Copula, nine, ["0x1p-21f", "0x1p-8f"]
    ),
    robust_stage!(
        "threshold robust anisotropic dithered", Class::Bits, Anisotropic, Dithered, steady, ["0xbb67ae85u", "0xbb67ae84u"]
    ),
    robust_stage!(
        "threshold robust isotropic inherit", Class::Bits, Isotropic, Inherit, steady, ["0x846ca68bu", "0x846ca68du"]
    ),
    robust_stage!(
        "threshold robust anisotropic inherit", Class::Bits, Anisotropic, Inherit, steady, ["vec3<u32>(0x10000u)", "vec3<u32>(1u)"]
    ),
];
