//! The scalar operations, each a loop over the lanes of a block.
//!
//! Floats follow [`Real`]: `fract` is `x - floor(x)`; of `min` and `max` the first argument wins when the comparison
//! is false, so a NaN in the first place stays and one in the second is dropped. A float becomes an integer towards
//! zero and saturates, NaN becomes 0. Integers wrap; `x / 0` is `x`, `x % 0` is 0; a shift takes the distance modulo
//! 32. Truth is all bits set.

use super::lanes::{Column, LANES, Lanes};
use super::model::DeviceModel;
use super::op::{Binary, Unary};
use crate::threshold::batch::Isa;
use crate::threshold::batch::block::Block;
use crate::threshold::batch::slices::{exp2_block, log2_block, sin_block};
use crate::threshold::emulated::{Arithmetic, Half};
use crate::threshold::real::Real;
use core::cell::Cell;

#[inline(always)]
fn words(to: &Column, from: &Column, f: impl Fn(u32) -> u32) {
    for (to, from) in to.iter().zip(from) {
        to.set(f(from.get()));
    }
}

#[inline(always)]
fn words_2(to: &Column, left: &Column, right: &Column, f: impl Fn(u32, u32) -> u32) {
    for ((to, left), right) in to.iter().zip(left).zip(right) {
        to.set(f(left.get(), right.get()));
    }
}

#[inline(always)]
fn floats(to: &Column, from: &Column, f: impl Fn(f32) -> f32) {
    words(to, from, |x| f(f32::from_bits(x)).to_bits());
}

#[inline(always)]
fn floats_2(to: &Column, left: &Column, right: &Column, f: impl Fn(f32, f32) -> f32) {
    words_2(to, left, right, |x, y| f(f32::from_bits(x), f32::from_bits(y)).to_bits());
}

/// A function of libm's, rounded once from `f64`.
#[inline(always)]
fn wide(to: &Column, from: &Column, f: impl Fn(f64) -> f64) {
    floats(to, from, |x| f(f64::from(x)) as f32);
}

/// A function of a whole block of floats.
#[inline(always)]
fn blocks(to: &Column, from: &Column, f: impl Fn(&Block<f32>, &mut Block<f32>)) {
    let arguments = core::array::from_fn(|lane| f32::from_bits(from[lane].get()));
    let mut values = [0.0; LANES];
    f(&arguments, &mut values);
    for (to, value) in to.iter().zip(values) {
        to.set(value.to_bits());
    }
}

/// All bits for true, none for false.
#[inline(always)]
fn truth(value: bool) -> u32 {
    u32::from(value).wrapping_neg()
}

#[inline(always)]
fn tests(to: &Column, left: &Column, right: &Column, f: impl Fn(f32, f32) -> bool) {
    words_2(to, left, right, |x, y| truth(f(f32::from_bits(x), f32::from_bits(y))));
}

#[inline(always)]
pub(super) fn unary<const FUSED: bool>(
    function: Unary,
    to: &Column,
    from: &Column,
    model: &DeviceModel,
    isa: Isa,
) {
    match function {
        Unary::Copy | Unary::Float => words(to, from, |x| x),
        Unary::Negate => words(to, from, |x| x ^ 0x8000_0000),
        Unary::Abs => words(to, from, |x| x & 0x7fff_ffff),
        Unary::Floor => floats(to, from, f32::floor),
        Unary::Ceil => floats(to, from, f32::ceil),
        Unary::Round => floats(to, from, f32::round_ties_even),
        Unary::Trunc => floats(to, from, f32::trunc),
        Unary::Fract => floats(to, from, |x| x - x.floor()),
        Unary::Sign => floats(to, from, |x| f32::from(x > 0.0) - f32::from(x < 0.0)),
        Unary::Sqrt => floats(to, from, f32::sqrt),
        Unary::InverseSqrt => wide(to, from, |x| 1.0 / x.sqrt()),
        Unary::Sin => match model.sin {
            None => blocks(to, from, sin_block::<FUSED>),
            Some(sin) => sin(isa, to, from),
        },
        Unary::Cos => (model.cos)(isa, to, from),
        Unary::Asin => wide(to, from, libm::asin),
        Unary::Acos => wide(to, from, libm::acos),
        Unary::Atan => wide(to, from, libm::atan),
        Unary::Sinh => wide(to, from, libm::sinh),
        Unary::Cosh => wide(to, from, libm::cosh),
        Unary::Tanh => wide(to, from, libm::tanh),
        Unary::Asinh => wide(to, from, libm::asinh),
        Unary::Acosh => wide(to, from, libm::acosh),
        Unary::Atanh => wide(to, from, libm::atanh),
        Unary::Exp => wide(to, from, libm::exp),
        Unary::Exp2 => blocks(to, from, exp2_block),
        Unary::Ln => wide(to, from, libm::log),
        Unary::Log2 => blocks(to, from, log2_block::<FUSED>),
        Unary::FrexpFraction => floats(to, from, |x| libm::frexpf(x).0),
        Unary::FrexpExponent => words(to, from, |x| libm::frexpf(f32::from_bits(x)).1 as u32),
        Unary::QuantizeToF16 => floats(to, from, |x| Half::round(f64::from(x))),
        Unary::ToF16Bits => words(to, from, |x| to_f16_bits(f32::from_bits(x))),
        Unary::FromF16Bits => words(to, from, |x| from_f16_bits(x).to_bits()),
        Unary::IsNan => words(to, from, |x| truth(f32::from_bits(x).is_nan())),
        Unary::IsInf => words(to, from, |x| truth(f32::from_bits(x).is_infinite())),
        Unary::FloatToSigned => words(to, from, |x| f32::from_bits(x) as i32 as u32),
        Unary::FloatToUnsigned => words(to, from, |x| f32::from_bits(x) as u32),
        Unary::FloatToBool => words(to, from, |x| truth(f32::from_bits(x) != 0.0)),
        Unary::SignedToFloat => words(to, from, |x| (x as i32 as f32).to_bits()),
        Unary::UnsignedToFloat => words(to, from, |x| (x as f32).to_bits()),
        Unary::IntegerToBool => words(to, from, |x| truth(x != 0)),
        Unary::BoolToInteger => words(to, from, |x| x & 1),
        Unary::BoolToFloat => words(to, from, |x| x & 1.0_f32.to_bits()),
        Unary::NegateInteger => words(to, from, u32::wrapping_neg),
        Unary::AbsInteger => words(to, from, |x| (x as i32).unsigned_abs()),
        Unary::SignInteger => words(to, from, |x| (x as i32).signum() as u32),
        Unary::Not => words(to, from, |x| !x),
        Unary::CountOnes => words(to, from, u32::count_ones),
        Unary::TrailingZeros => words(to, from, u32::trailing_zeros),
        Unary::LeadingZeros => words(to, from, u32::leading_zeros),
        Unary::ReverseBits => words(to, from, u32::reverse_bits),
        Unary::FirstTrailingBit => words(to, from, |x| if x == 0 { u32::MAX } else { x.trailing_zeros() }),
        Unary::FirstLeadingBit => words(to, from, first_leading_bit),
        Unary::FirstLeadingBitSigned => words(to, from, |x| first_leading_bit(x ^ truth((x as i32) < 0))),
    }
    if function.rounds() {
        model.round(isa, to);
    }
}

#[inline(always)]
pub(super) fn binary(
    function: Binary,
    to: &Column,
    left: &Column,
    right: &Column,
    model: &DeviceModel,
    isa: Isa,
) {
    /// A loop over two words that are read as signed integers.
    #[inline(always)]
    fn signed(to: &Column, left: &Column, right: &Column, f: impl Fn(i32, i32) -> i32) {
        words_2(to, left, right, |x, y| f(x as i32, y as i32) as u32);
    }
    match function {
        Binary::Add => floats_2(to, left, right, |x, y| x + y),
        Binary::Subtract => floats_2(to, left, right, |x, y| x - y),
        Binary::Multiply => floats_2(to, left, right, |x, y| x * y),
        Binary::Divide => floats_2(to, left, right, |x, y| x / y),
        Binary::Min => floats_2(to, left, right, Real::min),
        Binary::Max => floats_2(to, left, right, Real::max),
        Binary::Pow => floats_2(to, left, right, pow),
        Binary::Atan2 => floats_2(to, left, right, |y, x| libm::atan2(f64::from(y), f64::from(x)) as f32),
        Binary::Ldexp => words_2(to, left, right, |x, exponent| {
            (libm::ldexp(f64::from(f32::from_bits(x)), exponent as i32) as f32).to_bits()
        }),
        Binary::Less => tests(to, left, right, |x, y| x < y),
        Binary::LessEqual => tests(to, left, right, |x, y| x <= y),
        Binary::Equal => tests(to, left, right, |x, y| x == y),
        Binary::NotEqual => tests(to, left, right, |x, y| x != y),
        Binary::AddInteger => words_2(to, left, right, u32::wrapping_add),
        Binary::SubtractInteger => words_2(to, left, right, u32::wrapping_sub),
        Binary::MultiplyInteger => words_2(to, left, right, u32::wrapping_mul),
        Binary::DivideSigned => signed(to, left, right, |x, y| if y == 0 { x } else { x.wrapping_div(y) }),
        Binary::DivideUnsigned => words_2(to, left, right, |x, y| x.checked_div(y).unwrap_or(x)),
        Binary::RemainderSigned => signed(to, left, right, |x, y| if y == 0 { 0 } else { x.wrapping_rem(y) }),
        Binary::RemainderUnsigned => words_2(to, left, right, |x, y| x.checked_rem(y).unwrap_or(0)),
        Binary::MinSigned => signed(to, left, right, Ord::min),
        Binary::MinUnsigned => words_2(to, left, right, Ord::min),
        Binary::MaxSigned => signed(to, left, right, Ord::max),
        Binary::MaxUnsigned => words_2(to, left, right, Ord::max),
        Binary::LessSigned => words_2(to, left, right, |x, y| truth((x as i32) < y as i32)),
        Binary::LessUnsigned => words_2(to, left, right, |x, y| truth(x < y)),
        Binary::LessEqualSigned => words_2(to, left, right, |x, y| truth(x as i32 <= y as i32)),
        Binary::LessEqualUnsigned => words_2(to, left, right, |x, y| truth(x <= y)),
        Binary::EqualWord => words_2(to, left, right, |x, y| truth(x == y)),
        Binary::NotEqualWord => words_2(to, left, right, |x, y| truth(x != y)),
        Binary::And => words_2(to, left, right, |x, y| x & y),
        Binary::Or => words_2(to, left, right, |x, y| x | y),
        Binary::Xor => words_2(to, left, right, |x, y| x ^ y),
        Binary::ShiftLeft => words_2(to, left, right, u32::wrapping_shl),
        Binary::ShiftRightSigned => signed(to, left, right, |x, y| x.wrapping_shr(y as u32)),
        Binary::ShiftRightUnsigned => words_2(to, left, right, u32::wrapping_shr),
    }
    if function.rounds() {
        model.round(isa, to);
    }
}

/// Computes `a * b + c` with one rounding; the two signs are of the product and of `c`.
#[inline(always)]
pub(super) fn contracted_sum(
    to: &Column,
    [a, b, c]: [&Column; 3],
    [negate_product, negate_addend]: [bool; 2],
    model: &DeviceModel,
    isa: Isa,
) {
    let signed = |word: &Cell<u32>, negate: bool| {
        let value = f32::from_bits(word.get());
        if negate { -value } else { value }
    };
    for (((to, a), b), c) in to.iter().zip(a).zip(b).zip(c) {
        let sum = signed(a, negate_product).mul_add(signed(b, false), signed(c, negate_addend));
        to.set(sum.to_bits());
    }
    model.round(isa, to);
}

#[inline(always)]
pub(super) fn select(to: &Column, condition: &Column, accept: &Column, reject: &Column) {
    for (((to, condition), accept), reject) in to.iter().zip(condition).zip(accept).zip(reject) {
        let condition = condition.get();
        to.set((accept.get() & condition) | (reject.get() & !condition));
    }
}

/// Writes the active lanes.
#[inline(always)]
pub(super) fn store(to: &Column, from: &Column, active: Lanes) {
    if active == Lanes::MAX {
        return words(to, from, |x| x);
    }
    for (group, (to, from)) in to.chunks_exact(32).zip(from.chunks_exact(32)).enumerate() {
        let bits = (active >> (32 * group)) as u32;
        for (lane, (to, from)) in to.iter().zip(from).enumerate() {
            to.set(if bits >> lane & 1 == 1 { from.get() } else { to.get() });
        }
    }
}

/// Returns the lanes whose word `truth` maps to all bits; it maps the others to none.
pub(super) fn lanes(column: &Column, truth: impl Fn(u32) -> u32) -> Lanes {
    let mut lanes = 0;
    for (group, words) in column.chunks_exact(32).enumerate() {
        let bits =
            words.iter().enumerate().fold(0, |bits, (lane, word)| bits | (truth(word.get()) & (1 << lane)));
        lanes |= Lanes::from(bits) << (32 * group);
    }
    lanes
}

/// WGSL leaves the power of a negative number open; it is NaN here, as where it is `exp2(y * log2(x))`.
fn pow(x: f32, y: f32) -> f32 {
    if x < 0.0 { f32::NAN } else { libm::pow(f64::from(x), f64::from(y)) as f32 }
}

fn first_leading_bit(x: u32) -> u32 {
    31_u32.wrapping_sub(x.leading_zeros())
}

/// The smallest normal binary16 and the step of the subnormal ones.
const F16_NORMAL: f32 = 1.0 / 16_384.0;
const F16_STEP: f32 = 1.0 / 16_777_216.0;
/// The exponent of one in `f32` less that in binary16, in place.
const F16_REBIAS: u32 = 112 << 23;

fn to_f16_bits(x: f32) -> u32 {
    let rounded = Half::round(f64::from(x));
    let magnitude = rounded.abs();
    let sign = rounded.to_bits() >> 16 & 0x8000;
    sign | if magnitude.is_nan() {
        0x7e00
    } else if magnitude.is_infinite() {
        0x7c00
    } else if magnitude < F16_NORMAL {
        (magnitude / F16_STEP) as u32
    } else {
        (magnitude.to_bits() - F16_REBIAS) >> 13
    }
}

/// Reads the low 16 bits as a binary16.
fn from_f16_bits(bits: u32) -> f32 {
    let magnitude = bits & 0x7fff;
    let value = match magnitude >> 10 {
        0 => magnitude as f32 * F16_STEP,
        31 if magnitude == 0x7c00 => f32::INFINITY,
        31 => f32::NAN,
        _ => f32::from_bits((magnitude << 13) + F16_REBIAS),
    };
    if bits & 0x8000 == 0 { value } else { -value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn binary16_bits_are_those_of_the_half_crate() {
        for bits in 0..=0xffff_u16 {
            let (ours, theirs) = (from_f16_bits(u32::from(bits)), half::f16::from_bits(bits).to_f32());
            assert!(ours.to_bits() == theirs.to_bits() || ours.is_nan() && theirs.is_nan(), "{bits:x}");
            if !ours.is_nan() {
                assert_eq!(to_f16_bits(ours), u32::from(bits));
            }
        }
        for step in 0..200_000_u32 {
            let x = f32::from_bits(step.wrapping_mul(2_654_435_761));
            if !x.is_nan() {
                assert_eq!(to_f16_bits(x), u32::from(half::f16::from_f32(x).to_bits()), "{x:e}");
            }
        }
    }
}
