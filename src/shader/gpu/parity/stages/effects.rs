//! What follows a threshold: fading, strata, coverage, screen doors.

use super::super::input::{self, number, numbers};
use super::super::{Class, Stage};
use super::parts::{bounded, isotropic, number_stage, stable};
use crate::threshold::pipeline::{
    FadeIn, FrameStrata, Pipeline, SamplePattern, SampleStrata, ScreenDoor, Source,
};
use crate::threshold::stage::order::{Order, radical_inverse};
use crate::threshold::stage::stipple::{self, Density};
use crate::threshold::stage::{coverage, fade_in, screen_door, stratify};
use core::num::NonZeroU32;

const FRAMES: NonZeroU32 = NonZeroU32::new(8).unwrap();

/// Every stage on a source.
fn effects(base: Pipeline, order: Order) -> Pipeline {
    Pipeline {
        frame_strata: Some(FrameStrata { frames: FRAMES, order }),
        sample_strata: Some(SampleStrata { samples: FRAMES, pattern: SamplePattern::Decorrelated }),
        fade_in: Some(FadeIn { anisotropy: true, ..FadeIn::default() }),
        ..base
    }
}

fn stable_effects() -> Pipeline {
    effects(Pipeline::default(), Order::Alternating)
}

fn literal_effects() -> Pipeline {
    effects(isotropic(), Order::AlternatingLiteral)
}

fn sampled(pattern: SamplePattern) -> Pipeline {
    Pipeline { sample_strata: Some(SampleStrata { samples: FRAMES, pattern }), ..stable() }
}

fn ordered_by(order: Order) -> Pipeline {
    Pipeline { frame_strata: Some(FrameStrata { frames: FRAMES, order }), ..stable() }
}

fn door(door: ScreenDoor) -> Pipeline {
    Source::ScreenDoor(door).into()
}

/// Reads the number of strata in word `k`.
fn strata(words: &[u32], k: usize) -> NonZeroU32 {
    NonZeroU32::new(words[k]).unwrap_or(NonZeroU32::MIN)
}

#[rustfmt::skip]
pub(super) const STAGES: &[Stage] = &[
    number_stage!(
        "blend", bounded(6.0, 0.0, "the square of a quotient of 2.5 ULP"), stable_effects,
        "blend(number(0u), number(1u))", 2, input::lod,
        |words| fade_in::blend(number(words, 0), number(words, 1)),
        ["share * share", "share"]
    ),
    number_stage!(
        "blend literal", bounded(6.0, 0.0, "the square of a quotient of 2.5 ULP"), literal_effects,
        "blend_literal(number(0u), number(1u))", 2, input::lod,
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
        |words| fade_in::fade_in(0.5, number(words, 0), number(words, 1)),
        ["(1.0 - b) * 0.5", "(1.0 - b) * 0.499"]
    ),
    number_stage!(
        "fade in literal", bounded(2.0, 1.0 / 16_777_216.0, "a product and a sum that may be fused"), literal_effects,
        "fade_in_literal(number(0u), number(1u))", 2, input::faded,
        |words| fade_in::fade_in_literal(0.5, number(words, 0), number(words, 1)),
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
        "f32(alternating_literal(word(1u), word(2u)))", 3, input::stratum,
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
        "screen door, 8 x 8", bounded(2.5, 0.0, "a quotient: 2.5 ULP"), || door(ScreenDoor::Bayer),
        "regular(bayer(vec2<u32>(word(0u) >> 20u, word(1u) >> 20u)), 64u)", 2, input::faded,
        |words| screen_door::bayer([words[0] >> 20, words[1] >> 20]),
        ["(mixed & 4u) >> 1u", "(mixed & 4u) >> 2u"]
    ),
    number_stage!(
        "screen door, randomised", bounded(2.5, 0.0, "a quotient: 2.5 ULP"), || door(ScreenDoor::Randomised),
        "randomised(vec2<u32>(word(0u) >> 4u, word(1u) >> 4u), word(1u))", 2, input::faded,
        |words| screen_door::randomised([words[0] >> 4, words[1] >> 4], words[1]),
        ["2u + (pixel.y", "3u + (pixel.y"]
    ),
    number_stage!(
        "screen door, random mask", bounded(2.5, 0.0, "a quotient: 2.5 ULP"), || door(ScreenDoor::RandomMask(7)),
        "regular(random_mask(vec2<u32>(word(0u) >> 4u, word(1u) >> 4u), 7u), 16u)", 2, input::faded,
        |words| screen_door::random_mask([words[0] >> 4, words[1] >> 4], 7),
        ["if word < own_word", "if word <= own_word"]
    ),
    number_stage!(
        "pixel value", Class::Bits, || sampled(SamplePattern::ByPixel),
        "pixel_value(vec2<u32>(word(0u), word(1u)))", 2, input::faded,
        |words| coverage::pixel_value([words[0], words[1]]),
        ["pixel.x, pixel.y", "pixel.y, pixel.x"]
    ),
    number_stage!(
        "pixel mask", bounded(0.0, 4.0 / 16_777_216.0, "a quotient of 2.5 ULP below 1, and a sum below 2"), || sampled(SamplePattern::ByPixel),
        "turned(number(0u), word(1u), word(2u))", 3, input::stratum_off_jumps,
        |words| coverage::turned(number(words, 0), words[1], strata(words, 2)),
        ["let sum = chi + f32(i % n)", "let sum = chi + f32(i % n + 1u)"]
    ),
    number_stage!(
        "stipple", Class::Bits, || Source::Stipple { density: Density::High, kept: 0.5 }.into(),
        "select(0.5, 1.0, is_apart(vec2<u32>(word(0u) >> 20u, word(1u) >> 20u)))", 2, input::faded,
        |words| stipple::threshold(Density::High, [words[0] >> 20, words[1] >> 20], 0.5),
        ["& 1u", "& 2u"]
    ),
    number_stage!(
        "shuffled", Class::Bits, || sampled(SamplePattern::Shuffled),
        "f32(shuffled(word(0u), word(1u), word(2u)))", 3, input::stratum,
        |words| coverage::shuffled(words[0], words[1], strata(words, 2)) as f32,
        ["pcg(word + other) <", "pcg(word + other) <="]
    ),
    number_stage!(
        "regular", bounded(2.5, 0.0, "a quotient: 2.5 ULP"),
        || sampled(SamplePattern::Regular),
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
        "f32(decorrelated_literal(vec2<f32>(number(0u), number(1u)), word(2u), word(3u)))", 4, input::two_and_power,
        |words| coverage::decorrelated_literal(numbers(words, 0), words[2], strata(words, 3)) as f32,
        ["2u * u32", "4u * u32"]
    ),
];
