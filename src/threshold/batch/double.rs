//! The sine and the logarithm of `f64` without a branch: bit for bit those of libm, and faster ones.
//!
//! libm follows FreeBSD's msun (Sun Microsystems 1993): the sine takes off multiples of pi/2 in two parts and ends in
//! one of two polynomials, the logarithm keeps its leading half apart. The operations here are the same ones in the
//! same order; where libm would have taken another way than the common one, the answer is NaN.

use super::lane::Kernel;
use crate::threshold::real::{Real, SINE_OF_HALF_TURNS, floor_of_small, horner, log2_near_one};
use crate::threshold::robust::scales::below_one;

impl Kernel for f64 {
    const LARGEST_WORD: Self = 1_125_899_906_842_624.0;
    const LARGEST_SINE: Self = 90_000.0;
    const LARGEST_FAST_SINE: Self = 60_000_000.0;
    // 2^-800 and 2^800.
    const SCALES: [Self; 2] = [f64::from_bits(223 << 52), f64::from_bits(1823 << 52)];
    // 2^-784 and 2^958: within the bounds of the scaled length.
    const SQUARES: [Self; 2] = [f64::from_bits(239 << 52), f64::from_bits(1981 << 52)];

    #[inline(always)]
    fn lane_floor<const FUSED: bool>(self) -> Self {
        if FUSED { f64::floor(self) } else { floor_of_small(self) }
    }
    #[inline(always)]
    fn power(octave: i32) -> Self {
        f64::from_bits(((i64::from(octave) + 1023) << 52) as u64)
    }
    #[inline(always)]
    fn whole(number: i32) -> Self {
        f64::from(number)
    }
    #[inline(always)]
    fn lattice(word: u32) -> Self {
        f64::from((2 * (word >> 9) + 1) as i32) * (1.0 / 16_777_216.0)
    }
    #[inline(always)]
    fn octave<const FUSED: bool>(scale: Self) -> (i32, Self) {
        let log = log2(scale);
        let floor = log.lane_floor::<FUSED>();
        (floor.small_word() as i32, log - floor)
    }
    #[inline(always)]
    fn octave_by_exponent<const FUSED: bool>(scale: Self) -> (i32, Self) {
        (exponent(scale) as i32 - 1023, below_one(log2(mantissa(scale))))
    }
    #[inline(always)]
    fn sine<const FUSED: bool>(self) -> Self {
        sin(self)
    }
    #[inline(always)]
    fn octave_fast(scale: Self) -> (i32, Self) {
        let mantissa = mantissa(scale);
        let upper = mantissa > core::f64::consts::SQRT_2;
        let (near_one, whole) = if upper { (0.5 * mantissa, 1.0) } else { (mantissa, 0.0) };
        (exponent(scale) as i32 - 1023, below_one(log2_near_one::<true>(near_one, whole)))
    }
    #[inline(always)]
    fn sine_two_ulp(self) -> Self {
        sin_by_three_parts(self)
    }
    #[inline(always)]
    fn sine_fast(self) -> Self {
        sin_by_half_turns(self)
    }
    #[inline(always)]
    fn sine_coarse(self) -> Self {
        sin_by_half_turns(self)
    }
}

/// Adding 1.5 * 2^52 rounds to the nearest integer, which the low bits of the sum then hold.
const TO_INTEGER: f64 = 6_755_399_441_055_744.0;

/// Returns libm's sine for |x| below 2^20; NaN where libm may count quarter-turns otherwise, or takes three parts off.
#[inline(always)]
fn sin(x: f64) -> f64 {
    const QUARTER_TURNS: f64 = core::f64::consts::FRAC_2_PI;
    /// pi/2 in two parts, and the second part in two.
    const QUARTER: [f64; 2] = [1.570_796_326_734_125_614_17, 6.077_100_506_506_192_249_32e-11];
    const SECOND: [f64; 2] = [6.077_100_506_303_965_976_60e-11, 2.022_266_248_795_950_631_54e-21];
    /// pi/4 less what the boundaries between quarters are off, as libm reads them from the upper half of the number.
    const SURE: f64 = 0.785_388;
    /// Up to here, 9/4 pi and a little, libm looks for cancellation in another way.
    const SMALL: f64 = 7.1;
    let shifted = x * QUARTER_TURNS + TO_INTEGER;
    let quarters = shifted - TO_INTEGER;
    let first_rest = x - quarters * QUARTER[0];
    let first_low = quarters * QUARTER[1];
    let first = first_rest - first_low;
    let second_part = quarters * SECOND[0];
    let second_rest = first_rest - second_part;
    let second_low = quarters * SECOND[1] - ((first_rest - second_rest) - second_part);
    let second = second_rest - second_low;
    let lost = |high: f64| exponent(x) - exponent(high);
    let cancels = lost(first) > 16;
    let (rest, low, high) =
        if cancels { (second_rest, second_low, second) } else { (first_rest, first_low, first) };
    let tail = (rest - high) - low;
    let sine = sine_kernel(high, tail, quarters == 0.0);
    let cosine = cosine_kernel(high, tail);
    let bits = shifted.to_bits();
    let value = if bits & 1 == 0 { sine } else { cosine };
    let value = f64::from_bits(value.to_bits() ^ ((bits & 2) << 62));
    let two_are_enough = (lost(second) <= 49) & (x.abs() > SMALL);
    let sure = (high.abs() < SURE) & (!cancels | two_are_enough);
    if sure { value } else { f64::NAN }
}

/// Returns the sine with an absolute error below 2^-50 for |x| up to 2^30: the argument is counted in half-turns.
///
/// 1/pi has two parts, and the first product enters the difference to the nearest integer unrounded.
#[inline(always)]
fn sin_by_half_turns(x: f64) -> f64 {
    const PER_HALF_TURN: [f64; 2] = [core::f64::consts::FRAC_1_PI, f64::from_bits(0xbc76_b01e_c541_7056)];
    let shifted = x.mul_add(PER_HALF_TURN[0], TO_INTEGER);
    let nearest = shifted - TO_INTEGER;
    let rest = x.mul_add(PER_HALF_TURN[1], x.mul_add(PER_HALF_TURN[0], -nearest));
    let sine = rest * horner::<true, 8>(rest * rest, &SINE_OF_HALF_TURNS);
    f64::from_bits(sine.to_bits() ^ (shifted.to_bits() << 63))
}

/// Returns the sine within two units in the last place for |x| up to 2^30: multiples of pi, in three parts, are taken off.
///
/// The first difference is exact. An odd polynomial of degree 17 follows, with a relative error of 2^-61.
#[inline(always)]
fn sin_by_three_parts(x: f64) -> f64 {
    const PI: [f64; 3] =
        [core::f64::consts::PI, f64::from_bits(0x3ca1_a626_3314_5c07), f64::from_bits(0xb92f_1976_b7ed_8fbc)];
    const COEFFICIENTS: [f64; 8] = [
        f64::from_bits(0xbfc5_5555_5555_5555),
        f64::from_bits(0x3f81_1111_1111_10c8),
        f64::from_bits(0xbf2a_01a0_1a01_4d6f),
        f64::from_bits(0x3ec7_1de3_a52a_0b16),
        f64::from_bits(0xbe5a_e645_4d47_4685),
        f64::from_bits(0x3de6_123c_d074_93e1),
        f64::from_bits(0xbd6a_e438_4742_7fa3),
        f64::from_bits(0x3ce8_832a_84d7_db70),
    ];
    let shifted = x.mul_add(core::f64::consts::FRAC_1_PI, TO_INTEGER);
    let nearest = shifted - TO_INTEGER;
    let rest = (-nearest).mul_add(PI[2], (-nearest).mul_add(PI[1], (-nearest).mul_add(PI[0], x)));
    let squared = rest * rest;
    let sine = (rest * squared).mul_add(horner::<true, 8>(squared, &COEFFICIENTS), rest);
    f64::from_bits(sine.to_bits() ^ (shifted.to_bits() << 63))
}

/// Returns the mantissa of a positive normal number, in [1, 2).
#[inline(always)]
fn mantissa(x: f64) -> f64 {
    const MANTISSA: u64 = (1 << 52) - 1;
    const ONE: u64 = 0x3ff << 52;
    f64::from_bits((x.to_bits() & MANTISSA) | ONE)
}

/// Returns the biased exponent.
#[inline(always)]
fn exponent(x: f64) -> i64 {
    ((x.to_bits() >> 52) & 0x7ff) as i64
}

#[inline(always)]
fn sine_kernel(x: f64, tail: f64, is_whole: bool) -> f64 {
    const S: [f64; 6] = [
        -1.666_666_666_666_663_243_48e-01,
        8.333_333_333_322_489_461_24e-03,
        -1.984_126_982_985_794_931_34e-04,
        2.755_731_370_707_006_767_89e-06,
        -2.505_076_025_340_686_341_95e-08,
        1.589_690_995_211_550_102_21e-10,
    ];
    let z = x * x;
    let w = z * z;
    let r = S[1] + z * (S[2] + z * S[3]) + z * w * (S[4] + z * S[5]);
    let v = z * x;
    let whole = x + v * (S[0] + z * r);
    let with_tail = x - ((z * (0.5 * tail - v * r) - tail) - v * S[0]);
    if is_whole { whole } else { with_tail }
}

#[inline(always)]
fn cosine_kernel(x: f64, tail: f64) -> f64 {
    const C: [f64; 6] = [
        4.166_666_666_666_660_190_37e-02,
        -1.388_888_888_887_410_957_49e-03,
        2.480_158_728_947_672_941_78e-05,
        -2.755_731_435_139_066_330_35e-07,
        2.087_572_321_298_174_827_90e-09,
        -1.135_964_755_778_819_482_65e-11,
    ];
    let z = x * x;
    let w = z * z;
    let r = z * (C[0] + z * (C[1] + z * C[2])) + w * w * (C[3] + z * (C[4] + z * C[5]));
    let half = 0.5 * z;
    let lead = 1.0 - half;
    lead + (((1.0 - lead) - half) + (z * r - x * tail))
}

/// Returns libm's logarithm to base two of a positive normal number.
#[inline(always)]
fn log2(x: f64) -> f64 {
    const UPPER_HALF: u64 = 0xffff_ffff_0000_0000;
    const SQRT_HALF: u64 = 0x3fe6_a09e_0000_0000;
    const ONE: u64 = 0x3ff0_0000_0000_0000;
    const INVERSE_HIGH: f64 = 1.442_695_040_721_446_275_71;
    const INVERSE_LOW: f64 = 1.675_171_316_488_651_183_53e-10;
    const L: [f64; 7] = [
        6.666_666_666_666_735_130e-01,
        3.999_999_999_940_941_908e-01,
        2.857_142_874_366_239_149e-01,
        2.222_219_843_214_978_396e-01,
        1.818_357_216_161_805_012e-01,
        1.531_383_769_920_937_332e-01,
        1.479_819_860_511_658_591e-01,
    ];
    /// 2^52, and the same plus the bias of an exponent: together they turn an exponent into a number.
    const TWO_52: u64 = 0x4330_0000_0000_0000;
    const BIASED: f64 = 4_503_599_627_370_496.0 + 1023.0;
    let bits = x.to_bits().wrapping_add(ONE - SQRT_HALF);
    let exponent = f64::from_bits((bits >> 52) | TWO_52) - BIASED;
    let m = f64::from_bits((bits & 0x000f_ffff_ffff_ffff) + SQRT_HALF);
    let f = m - 1.0;
    let half_square = 0.5 * f * f;
    let s = f / (2.0 + f);
    let z = s * s;
    let w = z * z;
    let even = w * (L[1] + w * (L[3] + w * L[5]));
    let odd = z * (L[0] + w * (L[2] + w * (L[4] + w * L[6])));
    let r = odd + even;
    let high = f64::from_bits((f - half_square).to_bits() & UPPER_HALF);
    let low = f - high - half_square + s * (half_square + r);
    let value_high = high * INVERSE_HIGH;
    let value_low = (low + high) * INVERSE_LOW + low * INVERSE_HIGH;
    let sum = exponent + value_high;
    (value_low + ((exponent - sum) + value_high)) + sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::seed::{rng, uniform01};

    #[test]
    fn the_common_way_is_taken_nearly_always_and_is_that_of_libm() {
        let mut rng = rng("threshold.batch.double", 0);
        let n = 100_000;
        let unsure = (0..n)
            .filter(|_| {
                let x = (uniform01(&mut rng) - 0.5) * 2.0 * f64::LARGEST_SINE;
                let value = sin(x);
                assert!(value.is_nan() || value.to_bits() == libm::sin(x).to_bits(), "{x:e}");
                value.is_nan()
            })
            .count();
        assert!(unsure * 1_000 < n, "{unsure} of {n} arguments go to libm");
    }

    #[test]
    fn near_a_quarter_turn_the_second_part_is_enough() {
        for quarter in 5..10_000 {
            let x = f64::from(quarter) * core::f64::consts::FRAC_PI_2 + 1.0e-6;
            assert_eq!(sin(x).to_bits(), libm::sin(x).to_bits(), "{x:e}");
        }
    }

    #[test]
    fn the_faster_sines_are_as_exact_as_they_say() {
        let mut rng = rng("threshold.batch.sine_by_three_parts", 0);
        let anywhere: Vec<f64> = (0..1_000_000)
            .map(|i| (uniform01(&mut rng) - 0.5) * libm::exp2(10.0 + f64::from(i % 22)))
            .collect();
        let near_zeros = (1..100_000)
            .chain(300_000_000..300_100_000)
            .map(|half_turns| f64::from(half_turns) * core::f64::consts::PI);
        let (mut worst, mut absolute) = (0, 0.0_f64);
        for x in anywhere.into_iter().chain(near_zeros) {
            let (value, exact) = (sin_by_three_parts(x), core_math::sin(x));
            worst = worst.max(value.to_bits().abs_diff(exact.to_bits()));
            absolute = absolute.max((sin_by_half_turns(x) - exact).abs());
        }
        assert!((1..=2).contains(&worst), "{worst}");
        assert!((1.0e-16..libm::exp2(-50.0)).contains(&absolute), "{absolute:e}");
    }

    #[test]
    fn the_fast_octave_is_that_of_libm_within_a_few_last_places() {
        for i in 0..100_000 {
            let scale = libm::exp2(f64::from(i) * 1.3e-3 - 60.0);
            let ((octave, fraction), exact) = (f64::octave_fast(scale), libm::log2(scale));
            assert!((0.0..1.0).contains(&fraction), "{scale:e}: {fraction}");
            let off = f64::from(octave) + fraction - exact;
            assert!(off.abs() < libm::exp2(-46.0), "{scale:e}: {off:e}");
        }
        let powers = (-60..60).map(crate::threshold::real::power_of_two);
        assert!(powers.zip(-60..60).all(|(power, octave)| f64::octave_fast(power) == (octave, 0.0)));
    }

    #[test]
    fn the_exponent_is_the_biased_one() {
        for (x, expected) in [(1.0, 1023), (-0.75, 1022), (1.0e300, 2019), (0.0, 0)] {
            assert_eq!(exponent(x), expected);
        }
    }
}
