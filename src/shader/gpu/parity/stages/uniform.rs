//! From two hashes to a uniform value: the join and Eq. 2.

use super::super::input::{self, number, numbers};
use super::super::{Class, Stage};
use super::parts::{EQ_2, bounded, isotropic, number_stage, robust, stable};
use crate::threshold::cdf::{cdf, cdf_literal, minor_weight};
use crate::threshold::normal::{normal_cdf_f32, normal_quantile_f32};
use crate::threshold::real::Real;
use crate::threshold::robust::Join;
use crate::threshold::two_scale::Variant;

#[rustfmt::skip]
pub(super) const STAGES: &[Stage] = &[
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
        "normal quantile", bounded(0.0, 1.0e-6, "two polynomials whose products may enter their sums unrounded: 1 ULP of 5"),
        || robust(Variant::Isotropic, Join::Copula),
        "normal_quantile(number(0u))", 1, input::value,
        |words| normal_quantile_f32(number(words, 0)),
        ["- 119)", "- 118)"]
    ),
    number_stage!(
        "normal distribution", bounded(0.0, 2.5e-7, "two polynomials whose products may enter their sums unrounded: 2^-23"),
        || robust(Variant::Isotropic, Join::Copula),
        "normal_cdf(number(0u))", 1, input::deviation,
        |words| normal_cdf_f32(number(words, 0)),
        ["- 0.4592214", "- 0.4593214"]
    ),
];
