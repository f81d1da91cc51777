//! The sine and the logarithm of `f64` without a branch, bit for bit those of libm.
//!
//! libm follows FreeBSD's msun (Sun Microsystems 1993): the sine takes off multiples of pi/2 in two parts and ends in
//! one of two polynomials, the logarithm keeps its leading half apart. The operations here are the same ones in the
//! same order; where libm would have taken another way than the common one, the answer is NaN.

use super::lane::Kernel;
use crate::threshold::real::Real;
use crate::threshold::robust::scales::below_one;

impl Kernel for f64 {
    const LARGEST_WORD: Self = 1_125_899_906_842_624.0;
    const LARGEST_SINE: Self = 90_000.0;
    // 2^-800 and 2^800.
    const SCALES: [Self; 2] = [f64::from_bits(223 << 52), f64::from_bits(1823 << 52)];
    // 2^-784 and 2^958: within the bounds of the scaled length.
    const SQUARES: [Self; 2] = [f64::from_bits(239 << 52), f64::from_bits(1981 << 52)];
    const HAS_TIERS: bool = false;

    #[inline(always)]
    fn power(octave: i32) -> Self {
        f64::from_bits(((i64::from(octave) + 1023) << 52) as u64)
    }
    #[inline(always)]
    fn word(self) -> u32 {
        (self + TO_INTEGER).to_bits() as u32
    }
    #[inline(always)]
    fn lattice(word: u32) -> Self {
        f64::from((2 * (word >> 9) + 1) as i32) * (1.0 / 16_777_216.0)
    }
    #[inline(always)]
    fn octave<const FUSED: bool>(scale: Self) -> (i32, Self) {
        let log = log2(scale);
        let floor = Real::floor(log);
        (floor.word() as i32, log - floor)
    }
    #[inline(always)]
    fn octave_by_exponent<const FUSED: bool>(scale: Self) -> (i32, Self) {
        const MANTISSA: u64 = (1 << 52) - 1;
        const ONE: u64 = 0x3ff << 52;
        let mantissa = f64::from_bits((scale.to_bits() & MANTISSA) | ONE);
        (exponent(scale) as i32 - 1023, below_one(log2(mantissa)))
    }
    #[inline(always)]
    fn sine<const FUSED: bool>(self) -> Self {
        sin(self)
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
    fn the_exponent_is_the_biased_one() {
        for (x, expected) in [(1.0, 1023), (-0.75, 1022), (1.0e300, 2019), (0.0, 0)] {
            assert_eq!(exponent(x), expected);
        }
    }
}
