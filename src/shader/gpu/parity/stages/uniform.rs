//! From two hashes to a uniform value: the join and Eq. 2.

use super::super::input::{self, number, numbers};
use super::super::{Class, Stage};
use super::parts::{EQ_2, bounded, isotropic, number_stage, robust, stable};
use crate::threshold::cdf::{cdf, cdf_literal, minor_weight};
use crate::threshold::normal::{normal_cdf, normal_quantile};
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
];
