//! The table: every stage, what a device owes there, and an error that the comparison must see.

use super::input::{self, number, numbers, read_footprint};
use super::{Class, Stage};
use crate::shader::assemble::{Coverage, FadeIn, ScreenDoor, ShaderOptions, Source, Stratify};
use crate::technique::order::{Order, radical_inverse};
use crate::technique::screen_door;
use crate::threshold::cdf::{CdfForm, cdf, cdf_literal, minor_weight};
use crate::threshold::hash::{Cell, Hash, HashKind};
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::normal::{normal_cdf, normal_quantile};
use crate::threshold::real::Real;
use crate::threshold::robust::scales::{by_exponent, cell, corner_weight};
use crate::threshold::robust::{Join, Repairs, Robust};
use crate::threshold::two_scale::Variant;
use crate::threshold::{coverage, fade_in, stratify};
use core::num::{NonZeroU16, NonZeroU32};
use glam::Vec3;

const fn bounded(ulp: f64, absolute: f64, source: &'static str) -> Class {
    Class::Bounded { ulp, absolute, source }
}

/// 2^-21, what `log2` may be off on [1/2, 2].
const LOG2: f64 = 1.0 / 2_097_152.0;

/// In units of 2^-21, the lerp factor has the error of `log2` on the mantissa (1), of the quotient before it (0.9), of
/// the length before that (1.8) and of Rust's own rounding (0.1); a threshold has a slope of at most 2 over it, and Eq. 2
/// adds 0.5.
const ROBUST: Class = bounded(0.0, 8.1 * LOG2, "log2 2^-21 on [1, 2], quotients 2.5 ULP, sqrt 4.5 ULP");

/// As [`ROBUST`], with the logarithm of the whole scale, in [4, 16]: 3 ULP are 6 units.
const LISTING: Class = bounded(0.0, 19.0 * LOG2, "log2 3 ULP, quotients 2.5 ULP, sqrt 4.5 ULP");

/// A mixture of normal quantiles has a slope of at most 6 over the lerp factor; Rust computes it in `f64`.
const COPULA: Class =
    bounded(0.0, 32.0 * LOG2, "log2 2^-21 on [1, 2], log 3 ULP, exp 3 + 2|x| ULP, quotients 2.5 ULP");

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

const FRAMES: NonZeroU16 = NonZeroU16::new(8).unwrap();

/// Every effect, in the form that `source` asks for.
fn effects(source: Source) -> ShaderOptions {
    let literal = source == Source::Listing(CdfForm::Literal);
    let order = if literal { Order::AlternatingLiteral } else { Order::Alternating };
    ShaderOptions {
        source,
        stratify: Some(Stratify { frames: FRAMES, order }),
        coverage: Some(Coverage { samples: FRAMES, decorrelated: true }),
        fade_in: Some(FadeIn { full_noise_lod: 6.0, anisotropy: true }),
        ..isotropic()
    }
}

fn stable_effects() -> ShaderOptions {
    effects(Source::Robust(Join::Interpolate))
}

fn literal_effects() -> ShaderOptions {
    effects(Source::Listing(CdfForm::Literal))
}

fn ordered_by(order: Order) -> ShaderOptions {
    ShaderOptions { stratify: Some(Stratify { frames: FRAMES, order }), ..stable() }
}

fn door(door: ScreenDoor) -> ShaderOptions {
    ShaderOptions { source: Source::ScreenDoor(door), ..isotropic() }
}

/// Reads the number of strata in word `k`.
fn strata(words: &[u32], k: usize) -> NonZeroU32 {
    NonZeroU32::new(words[k]).unwrap_or(NonZeroU32::MIN)
}

fn hash_of(kind: HashKind, words: &[u32], out: &mut Vec<f32>) {
    out.push(kind.hash(&Cell { index: numbers(words, 0).into(), octave: words[3] }));
}

fn robust_threshold(variant: Variant, join: Join, words: &[u32], out: &mut Vec<f32>) {
    let robust = Robust { join, ..Robust::new(variant) };
    out.push(robust.threshold(&read_footprint(words)).unwrap_or(f32::NAN));
}

fn listing_threshold(variant: Variant, hash: HashKind, words: &[u32], out: &mut Vec<f32>) {
    let hashed = HashedAlpha { hash, variant, hash_scale: 1.0, form: CdfForm::Literal };
    out.push(hashed.threshold(&read_footprint(words)));
}

/// A hash of integers, or of the paper.
macro_rules! hash_stage {
    ($name:literal, $kind:expr, $class:expr, $octave:literal, $input:expr, [$right:literal, $wrong:literal]) => {
        Stage {
            name: $name,
            class: $class,
            options: || listing(Variant::Isotropic, $kind),
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

/// A whole threshold of nine numbers.
macro_rules! threshold_stage {
    ($name:literal, $class:expr, $options:expr, $input:expr, $reference:expr, [$right:literal, $wrong:literal]) => {
        Stage {
            name: $name,
            class: $class,
            options: $options,
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

/// Every stage, in the order of a threshold.
#[rustfmt::skip]
pub const STAGES: &[Stage] = &[
    number_stage!(
        "max derivative", bounded(5.0, 0.0, "sqrt as 1 / inverseSqrt: 2 + 2.5 ULP; sums that may be fused"), isotropic,
        "longest_derivative(
    vec3<f32>(number(3u), number(4u), number(5u)), vec3<f32>(number(6u), number(7u), number(8u)))",
        9, input::nine,
        |words| Variant::Isotropic.two_scale(&read_footprint(words), 1.0).max_derivative[0],
        ["v.y * v.y", "v.x * v.y"]
    ),
    vector_stage!(
        "max derivative, each axis", Class::Bits, anisotropic,
        "max(abs(vec3<f32>(number(3u), number(4u), number(5u))), abs(vec3<f32>(number(6u), number(7u), number(8u))))",
        9, input::nine,
        |words| Variant::Anisotropic.two_scale(&read_footprint(words), 1.0).max_derivative,
        ["max(abs(vec3<f32>(number(3u)", "max((vec3<f32>(number(3u)"]
    ),
    number_stage!(
        "pixel scale", bounded(2.5, 0.0, "a quotient: 2.5 ULP"), isotropic,
        "1.0 / (number(0u) * number(1u))", 2, input::derivative,
        |words| 1.0 / (number(words, 0) * number(words, 1)),
        ["1.0 / (number(0u)", "0.9999995 / (number(0u)"]
    ),
    vector_stage!(
        "pixel scale, each axis", bounded(2.5, 0.0, "a quotient: 2.5 ULP"), anisotropic,
        "0.707 / (number(0u) * vec3<f32>(number(1u), number(2u), number(3u)))", 4, input::derivatives,
        |words| numbers::<3>(words, 1).map(|derivative| 0.707 / (number(words, 0) * derivative)),
        ["0.707", "0.70710678"]
    ),
    number_stage!(
        "log2", bounded(3.0, LOG2, "log2: 3 ULP, 2^-21 on [1/2, 2]"), isotropic,
        "log2(number(0u))", 1, input::pixel_scale,
        |words| Real::log2(number(words, 0)),
        ["log2(number(0u))", "log(number(0u)) * 1.4427"]
    ),
    number_stage!(
        "exp2 of integers", bounded(255.0, 0.0, "exp2: 3 + 2|x| ULP, |x| up to 126"), isotropic,
        "exp2(number(0u))", 1, input::octave,
        |words| Real::exp2(number(words, 0)),
        ["exp2(number(0u))", "exp2(number(0u) * 1.000001)"]
    ),
    number_stage!(
        "lerp factor", Class::Bits, isotropic,
        "number(0u) - floor(number(0u))", 1, input::log_scale,
        |words| Real::fract(number(words, 0)),
        ["- floor(number(0u))", "- round(number(0u))"]
    ),
    number_stage!(
        "corner weight", bounded(16.0, 0.0, "sqrt 4.5 ULP twice, a quotient of 2.5 ULP"), anisotropic,
        "corner_weight(vec3<f32>(number(0u), number(1u), number(2u)))", 3, input::fractions,
        |words| corner_weight(numbers(words, 0)),
        ["1.0 - fraction", "0.99999 - fraction"]
    ),
    vector_stage!(
        "octave from the exponent", Class::Bits, || robust(Variant::Isotropic, Join::Interpolate),
        "vec3<f32>(scales_of(vec3<f32>(number(0u), number(1u), number(2u))).octave)", 3, input::pixel_scales,
        |words| numbers::<3>(words, 0).map(|scale| by_exponent(scale).0 as f32),
        ["- 127", "- 126"]
    ),
    vector_stage!(
        "fraction from the mantissa",
        bounded(0.0, 1.1 * LOG2, "log2: 2^-21 on [1, 2]; Rust rounds its own by 2^-25"),
        || robust(Variant::Isotropic, Join::Interpolate),
        "scales_of(vec3<f32>(number(0u), number(1u), number(2u))).fraction", 3, input::pixel_scales,
        |words| numbers::<3>(words, 0).map(|scale| by_exponent(scale).2),
        ["log2(mantissa)", "mantissa - 1.0"]
    ),
    vector_stage!(
        "cell", Class::Bits, isotropic,
        "cell_at(vec3<f32>(number(0u), number(1u), number(2u)),
    vec3<f32>(number(3u), number(4u), number(5u)), vec3<f32>(number(6u), number(7u), number(8u))).index",
        9, input::place,
        |words| {
            let (position, scale): ([f32; 3], [f32; 3]) = (numbers(words, 0), numbers(words, 3));
            [0, 1, 2].map(|axis| (scale[axis] * position[axis]).floor())
        },
        ["floor(scale * position)", "trunc(scale * position)"]
    ),
    number_stage!(
        "octave word", Class::Bits, isotropic,
        "open_lattice(cell_at(vec3<f32>(), vec3<f32>(), vec3<f32>(number(6u), number(7u), number(8u))).octave << 9u)",
        9, input::place,
        |words| {
            let octave = numbers::<3>(words, 6).map(Real::to_i32);
            let word = crate::threshold::hash::octave_word(octave);
            crate::threshold::hash::open_lattice(word << 9)
        },
        ["<< 11u", "<< 10u"]
    ),
    vector_stage!(
        "nested cell", Class::Bits, || robust(Variant::Isotropic, Join::Interpolate),
        "nested_cell(vec3<f32>(number(0u), number(1u), number(2u)),
    vec3<i32>(bitcast<i32>(word(3u)), bitcast<i32>(word(4u)), bitcast<i32>(word(5u)))).index",
        6, input::nested_place,
        |words| {
            let octave = [3, 4, 5].map(|k| words[k] as i32);
            let index: Vec3 = cell::<f32>(numbers(words, 0).into(), octave, Repairs::ALL).index;
            index.to_array()
        },
        ["vec3<f32>(0.6666667), is_even", "vec3<f32>(0.33333334), is_even"]
    ),
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
    number_stage!(
        "interpolated", bounded(2.0, 0.0, "two products and a sum that may be fused"), isotropic,
        "(1.0 - number(2u)) * number(0u) + number(2u) * number(1u)", 3, input::hashes,
        |words| {
            let [coarse, fine, weight] = numbers::<3>(words, 0);
            (1.0 - weight) * coarse + weight * fine
        },
        ["+ number(2u) *", "- number(2u) *"]
    ),
    number_stage!(
        "a", Class::Bits, isotropic,
        "min(number(1u), 1.0 - number(1u))", 2, input::mixture,
        |words| minor_weight(number(words, 1)),
        ["min(number(1u)", "max(number(1u)"]
    ),
    number_stage!(
        "cdf literal", EQ_2, isotropic,
        "cdf(number(0u), number(1u))", 2, input::mixture,
        |words| cdf_literal(number(words, 0), number(words, 1)),
        ["x < 1.0 - a", "x <= 1.0"]
    ),
    number_stage!(
        "cdf stable", EQ_2, stable,
        "cdf(number(0u), number(1u))", 2, input::mixture,
        |words| cdf(number(words, 0), number(words, 1)),
        ["from_top < a", "from_top < 0.0"]
    ),
    number_stage!(
        "clamp", Class::Bits, isotropic,
        "clamp(number(0u), 0.25, 0.75)", 1, input::value,
        |words| Real::clamp(number(words, 0), 0.25, 0.75),
        ["0.25, 0.75", "0.25, 1.0"]
    ),
    number_stage!(
        "normal quantile", bounded(0.0, 8.0e-6, "log 3 ULP; coefficients of AS 241 good to 1e-7 relative, in f32"),
        || robust(Variant::Isotropic, Join::Copula),
        "normal_quantile(number(0u))", 1, input::value,
        |words| normal_quantile(f64::from(number(words, 0))) as f32,
        ["180625", "180525"]
    ),
    number_stage!(
        "normal distribution", bounded(0.0, 1.0e-6, "exp 3 + 2|x| ULP below 1/2; a polynomial good to 2.4e-8"),
        || robust(Variant::Isotropic, Join::Copula),
        "normal_cdf(number(0u))", 1, input::deviation,
        |words| normal_cdf(f64::from(number(words, 0))) as f32,
        ["0.28 * abs(z)", "0.2801 * abs(z)"]
    ),
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
        "threshold robust isotropic copula", COPULA, Isotropic, Copula, nine, ["sum / sqrt(", "sum * sqrt("]
    ),
    robust_stage!(
        "threshold robust isotropic dithered", Class::Bits, Isotropic, Dithered, steady, ["^ 0x80000000u", "^ 0x40000000u"]
    ),
    robust_stage!(
        "threshold robust anisotropic interpolate", ROBUST, Anisotropic, Interpolate, steady, ["let to_ceil = length_of(1.0 - fraction)", "let to_ceil = length_of(fraction)"]
    ),
    robust_stage!(
        "threshold robust anisotropic copula", COPULA, Anisotropic, Copula, nine, ["0x1p-21f", "0x1p-8f"]
    ),
    robust_stage!(
        "threshold robust anisotropic dithered", Class::Bits, Anisotropic, Dithered, steady, ["axis << 24u", "axis << 25u"]
    ),
    number_stage!(
        "blend", bounded(6.0, 0.0, "the square of a quotient of 2.5 ULP"), stable_effects,
        "blend(number(0u), number(1u))", 2, input::lod,
        |words| fade_in::blend(number(words, 0), number(words, 1)),
        ["share * share", "share"]
    ),
    number_stage!(
        "blend literal", bounded(6.0, 0.0, "the square of a quotient of 2.5 ULP"), literal_effects,
        "blend(number(0u), number(1u))", 2, input::lod,
        |words| fade_in::blend_literal(number(words, 0), number(words, 1)),
        ["(lod / n) * (lod / n)", "(lod / n)"]
    ),
    number_stage!(
        "anisotropy", bounded(2.5, 0.0, "a quotient: 2.5 ULP"), stable_effects,
        "anisotropy(number(0u), number(1u))", 2, input::lengths,
        |words| fade_in::anisotropy(numbers(words, 0)),
        ["return 16.0", "return 15.0"]
    ),
    number_stage!(
        "fade in", bounded(2.0, 0.0, "two products and a sum that may be fused"), stable_effects,
        "fade_in(number(0u), number(1u))", 2, input::faded,
        |words| fade_in::fade_in(number(words, 0), number(words, 1)),
        ["(1.0 - b) * 0.5", "(1.0 - b) * 0.499"]
    ),
    number_stage!(
        "fade in literal", bounded(2.0, 1.0 / 16_777_216.0, "a product and a sum that may be fused"), literal_effects,
        "fade_in(number(0u), number(1u))", 2, input::faded,
        |words| fade_in::fade_in_literal(number(words, 0), number(words, 1)),
        ["(threshold_value - 0.5)", "(threshold_value - 0.501)"]
    ),
    number_stage!(
        "stratified", bounded(0.0, 4.0 / 16_777_216.0, "a quotient of 2.5 ULP below 1, and a sum below 2"),
        stable_effects,
        "stratified(number(0u), word(1u), word(2u))", 3, input::stratum_off_jumps,
        |words| stratify::stratified(number(words, 0), words[1], strata(words, 2)),
        ["f32(i % n) / f32(n)", "f32(i) / f32(n + 1u)"]
    ),
    number_stage!(
        "alternating", Class::Bits, stable_effects,
        "f32(alternating(word(1u), word(2u)))", 3, input::stratum,
        |words| stratify::alternating(words[1], strata(words, 2)) as f32,
        ["(n + 1u) / 2u", "n / 2u"]
    ),
    number_stage!(
        "alternating literal", Class::Bits, literal_effects,
        "f32(alternating(word(1u), word(2u)))", 3, input::stratum,
        |words| stratify::alternating_literal(words[1], strata(words, 2)) as f32,
        ["(n / 2u)", "((n + 1u) / 2u)"]
    ),
    number_stage!(
        "radical inverse", Class::Bits, || ordered_by(Order::VanDerCorputLiteral),
        "radical_inverse(word(1u))", 3, input::stratum,
        |words| radical_inverse(words[1], 2) as f32,
        [">> 8u) * 0x1p-24f", ">> 9u) * 0x1p-24f"]
    ),
    number_stage!(
        "order van der Corput", bounded(0.0, 4.0 / 16_777_216.0, "a quotient of 2.5 ULP below 1, and a sum below 2"),
        || ordered_by(Order::VanDerCorput),
        "stratified(number(0u), radical_rank(word(1u), word(2u)), word(2u))", 3, input::stratum_of_order,
        |words| Order::VanDerCorput.threshold(number(words, 0), words[1], strata(words, 2)),
        ["mirrored(other) <", "mirrored(other) <="]
    ),
    number_stage!(
        "order phase rotated", bounded(2.5, 4.0 / 16_777_216.0, "a quotient of 2.5 ULP; a product that may be fused"), || ordered_by(Order::PhaseRotated),
        "rotated(number(0u), alternating(entered(number(0u), word(1u), word(2u)), word(2u)), word(2u))",
        3, input::stratum,
        |words| Order::PhaseRotated.threshold(number(words, 0), words[1], strata(words, 2)),
        ["(i + u32(floor(chi * f32(n))) % n) % n", "i % n"]
    ),
    number_stage!(
        "screen door", bounded(2.5, 0.0, "a quotient: 2.5 ULP"), || door(ScreenDoor::Fixed),
        "regular(ordered(vec2<u32>(word(0u) >> 20u, word(1u) >> 20u)), 16u)", 2, input::faded,
        |words| screen_door::fixed([words[0] >> 20, words[1] >> 20]),
        ["place.x ^ place.y", "place.x"]
    ),
    number_stage!(
        "screen door, randomised", bounded(2.5, 0.0, "a quotient: 2.5 ULP"), || door(ScreenDoor::Randomised),
        "randomised(vec2<u32>(word(0u) >> 4u, word(1u) >> 4u), word(1u))", 2, input::faded,
        |words| screen_door::randomised([words[0] >> 4, words[1] >> 4], words[1]),
        ["2u + (pixel.y", "3u + (pixel.y"]
    ),
    number_stage!(
        "regular", bounded(2.5, 0.0, "a quotient: 2.5 ULP"),
        || ShaderOptions { source: Source::Regular(FRAMES), ..isotropic() },
        "regular(word(1u), word(2u))", 3, input::stratum,
        |words| coverage::regular(words[1], strata(words, 2)),
        ["+ 0.5", "+ 0.25"]
    ),
    number_stage!(
        "jittered", bounded(2.5, 0.0, "a quotient: 2.5 ULP"), stable_effects,
        "jittered(number(0u), word(1u), word(2u))", 3, input::stratum,
        |words| coverage::jittered(number(words, 0), words[1], strata(words, 2)),
        ["+ chi) / f32(n)", "+ chi) / f32(n + 1u)"]
    ),
    number_stage!(
        "decorrelated", Class::Bits, stable_effects,
        "f32(decorrelated(vec2<f32>(number(0u), number(1u)), word(2u), word(3u)))", 4, input::two_and_stratum,
        |words| coverage::decorrelated(numbers(words, 0), words[2], strata(words, 3)) as f32,
        ["a == 1u", "a >= 1u"]
    ),
    number_stage!(
        "decorrelated literal", Class::Bits, literal_effects,
        "f32(decorrelated(vec2<f32>(number(0u), number(1u)), word(2u), word(3u)))", 4, input::two_and_power,
        |words| coverage::decorrelated_literal(numbers(words, 0), words[2], strata(words, 3)) as f32,
        ["2u * u32", "4u * u32"]
    ),
];
