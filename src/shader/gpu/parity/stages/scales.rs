//! Scales and cells: from derivatives to octaves, fractions and indices.

use super::super::input::{self, number, numbers, read_footprint};
use super::super::{Class, Stage};
use super::parts::{LOG2, anisotropic, bounded, isotropic, number_stage, robust, vector_stage};
use crate::threshold::real::Real;
use crate::threshold::robust::scales::{by_exponent, corner_weight, nested_cell};
use crate::threshold::robust::{Join, Repairs};
use crate::threshold::two_scale::Variant;
use glam::Vec3;

#[rustfmt::skip]
pub(super) const STAGES: &[Stage] = &[
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
        "vec3<f32>(by_exponent(vec3<f32>(number(0u), number(1u), number(2u))).octave)", 3, input::pixel_scales,
        |words| numbers::<3>(words, 0).map(|scale| by_exponent(scale).0 as f32),
        ["- 127", "- 126"]
    ),
    vector_stage!(
        "fraction from the mantissa",
        bounded(0.0, 1.1 * LOG2, "log2: 2^-21 on [1, 2]; Rust rounds its own by 2^-25"),
        || robust(Variant::Isotropic, Join::Interpolate),
        "by_exponent(vec3<f32>(number(0u), number(1u), number(2u))).fraction", 3, input::pixel_scales,
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
            let index: Vec3 = nested_cell::<f32>(numbers(words, 0).into(), octave, Repairs::ALL).index;
            index.to_array()
        },
        ["vec3<f32>(0.6666667), is_even", "vec3<f32>(0.33333334), is_even"]
    ),
];
