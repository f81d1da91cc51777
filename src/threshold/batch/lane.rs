//! What a lane of a vector can do beyond [`Real`]: the steps of a threshold without a branch.
//!
//! Each is exact where the scalar path would have gone the same way, and NaN (or not asked at all) elsewhere: a lane
//! that ends as NaN is evaluated again by the scalar path.

use crate::threshold::exponent::exponent_and_mantissa;
use crate::threshold::real::{Real, floor_of_small, log2_of_normal, sin_in_domain};
use crate::threshold::robust::scales::below_one;

/// The branch-free steps.
pub trait Kernel: Real {
    /// Cells with coordinates up to this number have words that [`Real::small_word`] gives.
    const LARGEST_WORD: Self;
    /// Cells with coordinates up to this number have sines that [`Kernel::sine`] gives: 17.1 of them are in its domain.
    const LARGEST_SINE: Self;
    /// The same for the faster sines.
    const LARGEST_FAST_SINE: Self;
    /// Scales between these have neither an octave nor a cell that overflows.
    const SCALES: [Self; 2];
    /// Squares of lengths between these are neither rounded to zero nor infinite.
    const SQUARES: [Self; 2];

    /// Returns the floor of a magnitude below [`Real::SMALL`]; any number elsewhere, NaN for NaN. `FUSED`: the machine has a fused
    /// multiply-add; those that are compiled for have an instruction for this, too.
    fn lane_floor<const FUSED: bool>(self) -> Self;
    /// [`Real::fract`], likewise.
    #[inline(always)]
    fn lane_fract<const FUSED: bool>(self) -> Self {
        self - self.lane_floor::<FUSED>()
    }
    /// Returns two to the power of `octave`, exactly, for an octave of a normal number.
    fn power(octave: i32) -> Self;
    /// Returns a whole number of magnitude up to [`Real::SMALL`].
    fn whole(number: i32) -> Self;
    /// [`open_lattice`](crate::threshold::hash::open_lattice).
    fn lattice(word: u32) -> Self;
    /// Returns the octave of a scale and the place in it, in [0, 1], by the logarithm.
    fn octave<const FUSED: bool>(scale: Self) -> (i32, Self);
    /// Returns the octave of a scale by its exponent and the place in it, in [0, 1), by the logarithm of its mantissa.
    fn octave_by_exponent<const FUSED: bool>(scale: Self) -> (i32, Self);
    /// Returns the sine of an angle in radians as the scalar path does.
    fn sine<const FUSED: bool>(self) -> Self;

    /// [`Kernel::octave_by_exponent`] with the logarithm of the faster tiers.
    fn octave_fast(scale: Self) -> (i32, Self);
    /// Returns the sine of [`Tier::TwoUlp`](super::Tier::TwoUlp).
    fn sine_two_ulp(self) -> Self;
    /// Returns the sine of [`Tier::Fast`](super::Tier::Fast).
    fn sine_fast(self) -> Self;
    /// Returns the sine of [`Tier::Coarse`](super::Tier::Coarse).
    fn sine_coarse(self) -> Self;
}

impl Kernel for f32 {
    const LARGEST_WORD: Self = 4_194_303.0;
    const LARGEST_SINE: Self = 960_000.0;
    const LARGEST_FAST_SINE: Self = Self::LARGEST_SINE;
    // 2^-100 and 2^100.
    const SCALES: [Self; 2] = [f32::from_bits(27 << 23), f32::from_bits(227 << 23)];
    // 2^-98 and 2^119.
    const SQUARES: [Self; 2] = [f32::from_bits(29 << 23), f32::from_bits(246 << 23)];

    #[inline(always)]
    fn lane_floor<const FUSED: bool>(self) -> Self {
        if FUSED { f32::floor(self) } else { floor_of_small(self) }
    }
    #[inline(always)]
    fn power(octave: i32) -> Self {
        f32::from_bits((octave.wrapping_add(127) << 23) as u32)
    }
    #[inline(always)]
    fn whole(number: i32) -> Self {
        number as f32
    }
    #[inline(always)]
    fn lattice(word: u32) -> Self {
        (2 * (word >> 9) + 1) as i32 as f32 * (1.0 / 16_777_216.0)
    }
    #[inline(always)]
    fn octave<const FUSED: bool>(scale: Self) -> (i32, Self) {
        let log = log2_of_normal::<FUSED>(scale, 0);
        let floor = log.lane_floor::<FUSED>();
        (floor.small_word() as i32, log - floor)
    }
    #[inline(always)]
    fn octave_by_exponent<const FUSED: bool>(scale: Self) -> (i32, Self) {
        let (octave, mantissa) = exponent_and_mantissa(scale);
        (octave, below_one(log2_of_normal::<FUSED>(mantissa, 0)))
    }
    #[inline(always)]
    fn sine<const FUSED: bool>(self) -> Self {
        sin_in_domain::<FUSED>(self)
    }
    #[inline(always)]
    fn octave_fast(scale: Self) -> (i32, Self) {
        octave_fast(scale)
    }
    #[inline(always)]
    fn sine_coarse(self) -> Self {
        sin_by_one_product(self)
    }
    #[inline(always)]
    fn sine_fast(self) -> Self {
        sin_by_half_turns(self)
    }
    #[inline(always)]
    fn sine_two_ulp(self) -> Self {
        sin_by_three_parts(self)
    }
}

/// Adding and subtracting 1.5 * 2^23 rounds to the nearest integer, whose parity is then the lowest bit of the sum.
const TO_NEAREST: f32 = 12_582_912.0;

/// Returns the sine with an absolute error below 2^-12 for |x| up to pi, as a device may: half-turns are counted by one
/// rounded product, and a polynomial of degree 5 follows.
#[inline(always)]
fn sin_by_one_product(x: f32) -> f32 {
    const COEFFICIENTS: [f32; 3] =
        [f32::from_bits(0x4049_003f), f32::from_bits(0xc0a4_6187), f32::from_bits(0x4013_2bc9)];
    let half_turns = x * core::f32::consts::FRAC_1_PI;
    let shifted = half_turns + TO_NEAREST;
    let rest = half_turns - (shifted - TO_NEAREST);
    let sine = rest * horner(rest * rest, &COEFFICIENTS);
    f32::from_bits(sine.to_bits() ^ (shifted.to_bits() << 31))
}

/// Returns the sine with an absolute error below 2^-22 for |x| up to 2^20: the argument is counted in half-turns.
///
/// 1/pi has two parts, and the first product enters the difference to the nearest integer unrounded. An odd polynomial
/// of degree 9 follows (2^-28).
#[inline(always)]
fn sin_by_half_turns(x: f32) -> f32 {
    const PER_HALF_TURN: [f32; 2] = [f32::from_bits(0x3ea2_f983), f32::from_bits(0x325c_9c88)];
    const COEFFICIENTS: [f32; 5] = [
        f32::from_bits(0x4049_0fda),
        f32::from_bits(0xc0a5_5ddb),
        f32::from_bits(0x4023_33b5),
        f32::from_bits(0xbf19_195d),
        f32::from_bits(0x3d9e_2394),
    ];
    let shifted = x.mul_add(PER_HALF_TURN[0], TO_NEAREST);
    let nearest = shifted - TO_NEAREST;
    let rest = x.mul_add(PER_HALF_TURN[1], x.mul_add(PER_HALF_TURN[0], -nearest));
    let sine = rest * horner(rest * rest, &COEFFICIENTS);
    f32::from_bits(sine.to_bits() ^ (shifted.to_bits() << 31))
}

/// Returns the sine within 2.1 units in the last place for |x| up to 2^20: multiples of pi, in three parts, are taken off.
///
/// An odd polynomial of degree 9 follows, with a relative error of 2^-27.
#[inline(always)]
fn sin_by_three_parts(x: f32) -> f32 {
    const PER_HALF_TURN: f32 = f32::from_bits(0x3ea2_f983);
    const PI: [f32; 3] =
        [f32::from_bits(0x4049_0fdb), f32::from_bits(0xb3bb_bd2e), f32::from_bits(0xa777_2ced)];
    const COEFFICIENTS: [f32; 4] = [
        f32::from_bits(0xbe2a_aaa6),
        f32::from_bits(0x3c08_8769),
        f32::from_bits(0xb94f_b7ee),
        f32::from_bits(0x362e_ddf2),
    ];
    let shifted = x.mul_add(PER_HALF_TURN, TO_NEAREST);
    let nearest = shifted - TO_NEAREST;
    let rest = (-nearest).mul_add(PI[2], (-nearest).mul_add(PI[1], (-nearest).mul_add(PI[0], x)));
    let squared = rest * rest;
    let sine = (rest * squared).mul_add(horner(squared, &COEFFICIENTS), rest);
    f32::from_bits(sine.to_bits() ^ (shifted.to_bits() << 31))
}

/// Reads the octave off the exponent; the place in it has an absolute error below 2^-23.
#[inline(always)]
fn octave_fast(scale: f32) -> (i32, f32) {
    const COEFFICIENTS: [f32; 8] = [
        f32::from_bits(0x3fb8_aa10),
        f32::from_bits(0xbf38_9e53),
        f32::from_bits(0x3ef5_1608),
        f32::from_bits(0xbeb1_d174),
        f32::from_bits(0x3e77_ab6b),
        f32::from_bits(0xbe0c_d26c),
        f32::from_bits(0x3d55_3be1),
        f32::from_bits(0xbc18_8587),
    ];
    let (octave, mantissa) = exponent_and_mantissa(scale);
    let above_one = mantissa - 1.0;
    (octave, below_one(above_one * horner(above_one, &COEFFICIENTS)))
}

/// Evaluates `c0 + x (c1 + x (c2 + ...))`, each step rounded once.
#[inline(always)]
fn horner<const N: usize>(x: f32, coefficients: &[f32; N]) -> f32 {
    let mut sum = coefficients[N - 1];
    for &coefficient in coefficients[..N - 1].iter().rev() {
        sum = sum.mul_add(x, coefficient);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whole and broken arguments up to 2^20, both signs.
    fn arguments() -> impl Iterator<Item = f32> {
        (0..1 << 20).map(|i| i as f32).chain((0..200_000).map(|i| 0.37 * i as f32)).flat_map(|x| [x, -x])
    }

    /// Returns the greatest distance to the exact sine, in units of what is asked of `unit`.
    fn worst(sine: impl Fn(f32) -> f32, unit: impl Fn(f64) -> f64) -> f64 {
        arguments()
            .map(|x| {
                let exact = libm::sin(f64::from(x));
                (f64::from(sine(x)) - exact).abs() / unit(exact)
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn the_sine_by_half_turns_has_a_small_absolute_error() {
        let error = worst(sin_by_half_turns, |_| 1.0);
        assert!(error < libm::exp2(-22.0), "2^{}", libm::log2(error));
    }

    #[test]
    fn the_sine_by_one_product_is_good_for_one_turn_only() {
        let error = |x: f32| (f64::from(sin_by_one_product(x)) - libm::sin(f64::from(x))).abs();
        let within = (-31_415..=31_415).map(|i| error(i as f32 * 1e-4)).fold(0.0, f64::max);
        assert!(within < libm::exp2(-12.0), "2^{}", libm::log2(within));
        let beyond = (0..1000).map(|i| error(6e5 + i as f32 * 1.3)).fold(0.0, f64::max);
        assert!(beyond > libm::exp2(-7.0), "2^{}", libm::log2(beyond));
    }

    #[test]
    fn the_sine_by_three_parts_has_a_small_relative_error() {
        let last_place = |exact: f64| libm::exp2(libm::floor(libm::log2(exact.abs().max(1e-30))) - 23.0);
        let error = worst(sin_by_three_parts, last_place);
        assert!(error < 2.1, "{error} units");
        assert!(worst(sin_by_half_turns, last_place) > 2.1);
    }

    #[test]
    fn the_fast_octave_is_the_exact_one() {
        for i in 0..100_000 {
            let scale = libm::exp2(f64::from(i) * 2e-3 - 99.0) as f32;
            let (octave, fraction) = octave_fast(scale);
            let (expected, exact) = f32::octave_by_exponent::<false>(scale);
            assert_eq!(octave, expected, "{scale:e}");
            assert!((0.0..1.0).contains(&fraction), "{scale:e}: {fraction}");
            let off = f64::from(fraction) - f64::from(exact);
            assert!(off.abs() < libm::exp2(-22.5), "{scale:e}: {off:e}");
        }
    }
}
