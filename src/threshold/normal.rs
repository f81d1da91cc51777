//! The normal law, for joining hashes without losing uniformity: distribution function and quantile.
//!
//! Not in the paper. Portable: in `f64` only `libm` and arithmetic, in `f32` only sums, products and the exponent of a number,
//! without a branch, so that a vector of any width takes the same steps to the same bits, and so does a shader whose compiler does
//! not let products enter sums unrounded.

use super::exponent::exponent_and_mantissa;
use core::f64::consts::FRAC_1_SQRT_2;

/// A value whose quantile is asked for a join counts as no nearer to 0 or 1 than this, 2^-25: half a step inside the open
/// lattice, so that the quantile of a hash that reaches 0 or 1 is finite.
pub const QUANTILE_EDGE: f64 = 1.0 / 33_554_432.0;

/// Returns the normal quantile of `u` in [0, 1]; what is nearer to an end than [`QUANTILE_EDGE`] counts as that near, up to rounding.
/// NaN for NaN.
///
/// `u - 1/2` times a polynomial in the logarithm of `4 u (1 - u)`, itself by exponent and polynomial. `u` and `1 - u` have
/// quantiles of opposite sign, exactly. The probability that belongs to the quantile is within 2^-24 of `u`, and its distance to
/// the nearer end within 2^-14 of that distance.
#[inline(always)]
#[must_use]
pub fn normal_quantile_f32(u: f32) -> f32 {
    /// Of log2(1 + f) for f in [0, 1), constant term first.
    const LOGARITHM: [f32; 8] = [
        2.772_748_4e-7,
        1.442_656_3,
        -0.720_453,
        0.472_897_95,
        -0.324_253_95,
        0.192_089_57,
        -0.078_062_14,
        0.015_125_36,
    ];
    /// Of the quantile over `u - 1/2`, in log2(4 u (1 - u)) + 6, which lies between -17 and 6.
    const QUANTILE: [f32; 14] = [
        5.359_523_3,
        -0.443_166_8,
        -0.009_921_332,
        1.241_066_3e-4,
        6.977_864_5e-5,
        6.828_448e-6,
        1.995_884_7e-7,
        -3.268_575_5e-8,
        -4.388_371e-9,
        -1.366_586_3e-10,
        1.388_368_3e-11,
        1.511_379_7e-12,
        5.671_88e-14,
        7.844_681_3e-16,
    ];
    const EDGE: f32 = QUANTILE_EDGE as f32;
    let tail = if u < 0.5 { u } else { 1.0 - u };
    let tail = if tail < EDGE { EDGE } else { tail };
    let (exponent, mantissa) = exponent_and_mantissa(tail * (1.0 - tail));
    // Two for the factor four, and six.
    let logarithm = (exponent + 8) as f32 + polynomial(mantissa - 1.0, &LOGARITHM);
    (u - 0.5) * polynomial(logarithm, &QUANTILE)
}

/// Returns the probability that a standard normal variable is at most `z`, in (0, 1], within 1.3 * 2^-24 of it; NaN for NaN.
///
/// The lower tail is two to the power of a polynomial and has a relative error below 2^-16; below -5.7 it is that of -5.7,
/// 6e-9. The values of `z` and `-z` add up to 1 exactly, as `f32` adds. From one `z` to the next it may fall by a rounding.
#[inline(always)]
#[must_use]
pub fn normal_cdf_f32(z: f32) -> f32 {
    const REACH: f32 = 5.7;
    /// Of the logarithm to base two of the lower tail, in |z|.
    const LOGARITHM: [f32; 11] = [
        -1.0,
        -1.151_104_3,
        -0.459_221_4,
        -0.052_432_9,
        0.006_922_451,
        3.155_813_5e-5,
        -3.011_109e-4,
        8.460_940_4e-5,
        -1.270_229_1e-5,
        1.051_546_4e-6,
        -3.752_076_7e-8,
    ];
    /// Of two to the power of f in [-1/2, 1/2].
    const POWER: [f32; 7] = [
        1.0,
        core::f32::consts::LN_2,
        0.240_226_46,
        0.055_503_286,
        0.009_618_489,
        0.001_339_993_1,
        1.534_581_2e-4,
    ];
    /// Adding 1.5 * 2^23 rounds to the nearest integer, which the low bits of the sum then hold.
    const TO_INTEGER: f32 = 12_582_912.0;
    let distance = if z.abs() > REACH { REACH } else { z.abs() };
    let logarithm = polynomial(distance, &LOGARITHM);
    let shifted = logarithm + TO_INTEGER;
    let rest = logarithm - (shifted - TO_INTEGER);
    let power = f32::from_bits((shifted.to_bits() << 23).wrapping_add(1.0_f32.to_bits()));
    let tail = polynomial(rest, &POWER) * power;
    if z < 0.0 { tail } else { 1.0 - tail }
}

/// Evaluates `c0 + x (c1 + x (c2 + ...))`, each product and each sum rounded.
#[inline(always)]
fn polynomial<const N: usize>(x: f32, coefficients: &[f32; N]) -> f32 {
    let mut sum = coefficients[N - 1];
    for &coefficient in coefficients[..N - 1].iter().rev() {
        sum = sum * x + coefficient;
    }
    sum
}

/// Returns the probability that a standard normal variable is at most `z`, in [0, 1].
///
/// A true tail on both sides: the relative error stays below 1e-14 out to |z| = 5.5, the range of the open lattice.
#[must_use]
pub fn normal_cdf(z: f64) -> f64 {
    0.5 * libm::erfc(-z * FRAC_1_SQRT_2)
}

/// Returns the `z` at which [`normal_cdf`] reaches `probability`; -inf at 0, +inf at 1, NaN outside [0, 1].
///
/// Relative error below 1e-15: the rational functions of Wichura's algorithm AS 241 (Applied Statistics 37, 1988).
#[must_use]
pub fn normal_quantile(probability: f64) -> f64 {
    let centred = probability - 0.5;
    if centred.abs() <= 0.425 {
        return centred * ratio(0.180_625 - centred * centred, &CENTRE);
    }
    let tail = if centred < 0.0 { probability } else { 1.0 - probability };
    if tail <= 0.0 {
        return if tail == 0.0 { centred.signum() * f64::INFINITY } else { f64::NAN };
    }
    let r = (-libm::log(tail)).sqrt();
    let distance = if r <= 5.0 { ratio(r - 1.6, &TAIL) } else { ratio(r - 5.0, &FAR_TAIL) };
    centred.signum() * distance
}

/// Numerator and denominator coefficients, constant term first.
type Rational = [[f64; 8]; 2];

fn ratio(x: f64, [numerator, denominator]: &Rational) -> f64 {
    let horner = |coefficients: &[f64; 8]| coefficients.iter().rev().fold(0.0, |sum, &c| sum * x + c);
    horner(numerator) / horner(denominator)
}

const CENTRE: Rational = [
    [
        3.387_132_872_796_366_608,
        133.141_667_891_784_377_45,
        1_971.590_950_306_551_442_7,
        13_731.693_765_509_461_125,
        45_921.953_931_549_871_457,
        67_265.770_927_008_700_853,
        33_430.575_583_588_128_105,
        2_509.080_928_730_122_672_7,
    ],
    [
        1.0,
        42.313_330_701_600_911_252,
        687.187_007_492_057_908_3,
        5_394.196_021_424_751_107_7,
        21_213.794_301_586_595_867,
        39_307.895_800_092_710_61,
        28_729.085_735_721_942_674,
        5_226.495_278_852_854_561,
    ],
];

const TAIL: Rational = [
    [
        1.423_437_110_749_683_577_34,
        4.630_337_846_156_545_295_9,
        5.769_497_221_460_691_405_5,
        3.647_848_324_763_204_605_04,
        1.270_458_252_452_368_382_58,
        0.241_780_725_177_450_611_77,
        0.022_723_844_989_269_184_583_3,
        7.745_450_142_783_414_076_4e-4,
    ],
    [
        1.0,
        2.053_191_626_637_758_821_87,
        1.676_384_830_183_803_849_4,
        0.689_767_334_985_100_004_55,
        0.148_103_976_427_480_074_59,
        0.015_198_666_563_616_457_196_6,
        5.475_938_084_995_344_946e-4,
        1.050_750_071_644_416_843_24e-9,
    ],
];

const FAR_TAIL: Rational = [
    [
        6.657_904_643_501_103_777_2,
        5.463_784_911_164_114_369_9,
        1.784_826_539_917_291_335_8,
        0.296_560_571_828_504_891_23,
        0.026_532_189_526_576_123_093,
        0.001_242_660_947_388_078_438_6,
        2.711_555_568_743_487_578_15e-5,
        2.010_334_399_292_288_132_65e-7,
    ],
    [
        1.0,
        0.599_832_206_555_887_937_69,
        0.136_929_880_922_735_805_31,
        0.014_875_361_290_850_614_852_5,
        7.868_691_311_456_132_591e-4,
        1.846_318_317_510_054_681_8e-5,
        1.421_511_758_316_445_888_7e-7,
        2.044_263_103_389_939_785_64e-15,
    ],
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Quantiles from mpmath at 40 digits.
    #[test]
    fn quantiles_agree_with_a_high_precision_evaluation() {
        for (probability, expected) in [
            (libm::exp2(-24.0), -5.29470408485459806),
            (1e-300, -37.0470962993611992),
            (0.01, -2.32634787404084109),
            (0.3, -0.524400512708040816),
            (0.5, 0.0),
            (0.975, 1.95996398454005386),
        ] {
            let relative = (normal_quantile(probability) - expected).abs() / expected.abs().max(1.0);
            assert!(relative < 4e-16, "{probability}: {}", normal_quantile(probability));
        }
    }

    #[test]
    fn the_quantile_inverts_the_distribution_function() {
        for i in 1..1000 {
            let p = f64::from(i) / 1000.0;
            assert!((normal_cdf(normal_quantile(p)) - p).abs() < 1e-15);
        }
    }

    #[test]
    fn ends_and_beyond() {
        assert_eq!(normal_quantile(0.0), f64::NEG_INFINITY);
        assert_eq!(normal_quantile(1.0), f64::INFINITY);
        assert!(normal_quantile(-0.1).is_nan() && normal_quantile(f64::NAN).is_nan());
        assert_eq!(normal_cdf(f64::NEG_INFINITY), 0.0);
    }

    /// Every value of the open lattice.
    fn lattice() -> impl Iterator<Item = f32> {
        (0..1 << 23).map(|k: u32| (2 * k + 1) as f32 / 16_777_216.0)
    }

    #[test]
    fn a_quantile_in_f32_and_its_probability_are_within_their_bounds() {
        let unit = libm::exp2(-24.0);
        for u in lattice() {
            let (exact, quantile) = (f64::from(u), normal_quantile_f32(u));
            let back = normal_cdf(f64::from(quantile));
            let off = (back - exact).abs();
            assert!(off < unit && off < libm::exp2(-14.0) * exact.min(1.0 - exact), "{u}: {off:e}");
            let off = (f64::from(normal_cdf_f32(quantile)) - exact).abs();
            assert!(off <= 1.25 * unit, "{u}: {off:e}");
        }
        for z in (-57_000..=57_000).map(|i| i as f32 * 1e-4) {
            let exact = normal_cdf(f64::from(z));
            let off = (f64::from(normal_cdf_f32(z)) - exact).abs();
            assert!(off < 1.3 * unit && (z > 0.0 || off < exact * libm::exp2(-16.0)), "{z}: {off:e}");
        }
    }

    #[test]
    fn f32_has_both_halves_alike_and_rises_but_for_roundings() {
        for u in lattice() {
            assert_eq!(normal_quantile_f32(u), -normal_quantile_f32(1.0 - u), "{u}");
        }
        let mut last = 0.0;
        for z in (-600_000..=600_000).map(|i| i as f32 * 1e-5) {
            let probability = normal_cdf_f32(z);
            assert!(probability >= last * (1.0 - 4.0 * f32::EPSILON) && probability <= 1.0, "{z}");
            assert_eq!(probability + normal_cdf_f32(-z), 1.0, "{z}");
            last = probability;
        }
    }

    #[test]
    fn ends_in_f32_are_half_a_step_inside_and_nan_stays() {
        let least = normal_quantile_f32(QUANTILE_EDGE as f32);
        assert!((least + 5.419_98).abs() < 1e-4, "{least}");
        assert!((normal_quantile_f32(0.0) / least - 1.0).abs() < 1e-6);
        assert_eq!(normal_quantile_f32(1.0), -normal_quantile_f32(0.0));
        assert_eq!(normal_quantile_f32(0.5), 0.0);
        assert!(normal_quantile_f32(f32::NAN).is_nan() && normal_cdf_f32(f32::NAN).is_nan());
        assert_eq!(normal_cdf_f32(f32::INFINITY), 1.0);
        assert!(normal_cdf_f32(f32::NEG_INFINITY) < 1e-8);
    }
}
