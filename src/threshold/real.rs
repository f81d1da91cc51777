//! The scalar that every listing is written over: `f32` or `f64` with the semantics of GLSL.
//!
//! Three things differ from Rust's own floats. [`Real::fract`] is `x - floor(x)`, so that it is in [0, 1] for
//! negative arguments too (Rust's truncates). [`Real::min`] and [`Real::max`] are GLSL's: the first argument wins
//! when the comparison is false, so a NaN in the first place stays and a NaN in the second place is dropped. And the
//! three transcendentals are portable: for `f32` they are correctly rounded, for `f64` they are those of the pure
//! Rust `libm` crate. Both give the same bits on every machine.
//!
//! Together with IEEE arithmetic in the order of the listing and without contraction, this fixes one meaning for
//! every `f32` threshold, the *reference semantics R32*.

use super::exponent::exponent_and_mantissa;
use super::normal::{QUANTILE_EDGE, normal_cdf, normal_cdf_f32, normal_quantile, normal_quantile_f32};
use core::fmt::{Debug, Display};
use core::ops::{Add, Div, Mul, Neg, Sub};
use core::str::FromStr;

pub(super) mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// A floating-point type with GLSL semantics: `f32`, `f64`, or a model of another arithmetic
/// ([`Emulated`](super::emulated::Emulated)), and no other.
pub trait Real:
    sealed::Sealed
    + Copy
    + Debug
    + Default
    + Display
    + FromStr
    + PartialEq
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Send
    + Sync
    + 'static
{
    /// glam's vector of three components of this type.
    type Vec3: Copy + Debug + PartialEq + From<[Self; 3]> + Into<[Self; 3]> + Send + Sync + 'static;

    /// `"f32"` or `"f64"`, or the name of an emulated arithmetic.
    const NAME: &'static str;

    /// Exponent of the largest power of two: 127 for `f32`, 1023 for `f64`.
    const MAX_EXPONENT: i32;

    /// Rounds to nearest, ties to even.
    #[must_use]
    fn from_f64(value: f64) -> Self;

    /// Converts without loss.
    #[must_use]
    fn to_f64(self) -> f64;

    /// Returns the low 32 bits of an integral value in two's complement; a value beyond the range of `i64` saturates
    /// there, NaN gives 0.
    #[must_use]
    fn to_word(self) -> u32;

    /// The same for an integral value of a magnitude below [`Real::SMALL`]; any word for others.
    #[must_use]
    fn small_word(self) -> u32;

    /// Converts an integral value to `i32`, saturating; NaN gives 0.
    #[must_use]
    fn to_i32(self) -> i32;

    /// Numbers of a magnitude below this have a nearest whole number by [`Real::nearest`].
    const SMALL: Self;

    /// Returns the integral value that is nearest to `self`, the even one of two, where the magnitude of `self` is below
    /// [`Real::SMALL`]; any number elsewhere.
    #[must_use]
    fn nearest(self) -> Self;

    /// Returns the largest integral value that is not above `self`.
    ///
    /// By sums and not by the standard library, whose function is a call where a machine is not known to round by an
    /// instruction.
    #[must_use]
    fn floor(self) -> Self;

    /// Returns the smallest integral value that is not below `self`.
    #[must_use]
    fn ceil(self) -> Self;

    /// Clears the sign.
    #[must_use]
    fn abs(self) -> Self;

    /// Returns the correctly rounded square root; NaN below zero.
    #[must_use]
    fn sqrt(self) -> Self;

    /// Returns the sine of an angle in radians.
    ///
    /// `f32`: correctly rounded for |x| up to 2^24 (see [`sin_f32`]). `f64`: libm's, below 1 ULP.
    #[must_use]
    fn sin(self) -> Self;

    /// Returns the sines of several angles, those of [`Real::sin`]; in `f32` side by side.
    #[inline(always)]
    #[must_use]
    fn sin_all<const N: usize>(angles: [Self; N]) -> [Self; N] {
        angles.map(Self::sin)
    }

    /// Returns the logarithm to base two; NaN below zero, -inf at zero.
    ///
    /// `f32`: correctly rounded for every argument (see [`log2_f32`]). `f64`: libm's, below 1 ULP.
    #[must_use]
    fn log2(self) -> Self;

    /// Takes a positive normal number apart: its exponent, and the logarithm to base two of its mantissa in [1, 2), which is
    /// in [0, 1].
    #[must_use]
    fn exponent_and_log2(self) -> (i32, Self);

    /// Returns two to the power of `self`; exact for integral arguments in range.
    ///
    /// `f32`: correctly rounded for every argument (see [`exp2_f32`]). `f64`: libm's, below 1 ULP.
    #[must_use]
    fn exp2(self) -> Self;

    /// Returns the normal quantile of a value in [0, 1]; what is nearer to an end than 2^-25 counts as that near.
    ///
    /// `f32`: by [`normal_quantile_f32`]. `f64`: by [`normal_quantile`].
    #[must_use]
    fn normal_quantile(self) -> Self;

    /// Returns the probability that a standard normal variable is at most `self`.
    ///
    /// `f32`: by [`normal_cdf_f32`]. `f64`: by [`normal_cdf`].
    #[must_use]
    fn normal_cdf(self) -> Self;

    /// Returns true for NaN.
    #[must_use]
    fn is_nan(self) -> bool;

    /// Returns true for anything but NaN and the infinities.
    #[must_use]
    fn is_finite(self) -> bool;

    /// Returns `self - floor(self)`, GLSL's `fract`.
    ///
    /// The value is in [0, 1]: rounding brings it to exactly 1 for a negative argument closer to zero than half an
    /// ULP of one.
    #[inline]
    #[must_use]
    fn fract(self) -> Self {
        self - self.floor()
    }

    /// Returns `other` where `other < self`, else `self` (GLSL's `min`; a NaN in `self` stays).
    #[inline]
    #[must_use]
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// Returns `other` where `self < other`, else `self` (GLSL's `max`; a NaN in `self` stays).
    #[inline]
    #[must_use]
    fn max(self, other: Self) -> Self {
        if self < other { other } else { self }
    }

    /// Returns `min(max(self, low), high)`, GLSL's `clamp`; NaN stays NaN.
    #[inline]
    #[must_use]
    fn clamp(self, low: Self, high: Self) -> Self {
        Real::min(Real::max(self, low), high)
    }
}

/// Implements the part of [`Real`] that is the same text for both types.
macro_rules! shared_items {
    ($real:ty, $vec3:ty) => {
        type Vec3 = $vec3;
        const NAME: &'static str = stringify!($real);
        const MAX_EXPONENT: i32 = <$real>::MAX_EXP - 1;

        #[inline]
        fn to_word(self) -> u32 {
            if self.abs() < Self::SMALL { self.small_word() } else { self as i64 as u32 }
        }
        #[inline(always)]
        fn small_word(self) -> u32 {
            /// Added to a whole number up to a third of it, leaves that number in the low bits.
            const TO_INTEGER: $real = 1.5 / <$real>::EPSILON;
            (self + TO_INTEGER).to_bits().wrapping_sub(TO_INTEGER.to_bits()) as u32
        }
        #[inline]
        fn to_i32(self) -> i32 {
            self as i32
        }
        const SMALL: Self = 0.5 / <$real>::EPSILON;
        #[inline]
        fn nearest(self) -> Self {
            /// Beside this number there are no others than whole ones.
            const SHIFT: $real = 1.5 / <$real>::EPSILON;
            (self + SHIFT) - SHIFT
        }
        #[inline]
        fn floor(self) -> Self {
            if self.abs() < Self::SMALL {
                // Minus zero keeps its sign, which every other number below zero has anyway.
                let sign = self.to_bits() & (-0.0 as $real).to_bits();
                <$real>::from_bits(floor_of_small(self).to_bits() | sign)
            } else {
                <$real>::floor(self)
            }
        }
        #[inline]
        fn ceil(self) -> Self {
            -Real::floor(-self)
        }
        #[inline]
        fn abs(self) -> Self {
            <$real>::abs(self)
        }
        #[inline]
        fn sqrt(self) -> Self {
            <$real>::sqrt(self)
        }
        #[inline]
        fn is_nan(self) -> bool {
            <$real>::is_nan(self)
        }
        #[inline]
        fn is_finite(self) -> bool {
            <$real>::is_finite(self)
        }
    };
}

impl Real for f32 {
    shared_items!(f32, glam::Vec3);

    #[inline]
    fn from_f64(value: f64) -> Self {
        value as f32
    }
    #[inline]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
    #[inline]
    fn sin(self) -> Self {
        sin_f32(self)
    }
    #[inline(always)]
    fn sin_all<const N: usize>(angles: [Self; N]) -> [Self; N] {
        let mut all_within = true;
        for angle in angles {
            all_within &= angle.abs() <= SIN_F32_DOMAIN;
        }
        if all_within { angles.map(sin_in_domain::<false>) } else { angles.map(sin_f32) }
    }
    #[inline]
    fn log2(self) -> Self {
        log2_f32(self)
    }
    #[inline(always)]
    fn exponent_and_log2(self) -> (i32, Self) {
        let (exponent, mantissa) = exponent_and_mantissa(self);
        (exponent, log2_of_normal::<false>(mantissa, 0))
    }
    #[inline]
    fn exp2(self) -> Self {
        exp2_f32(self)
    }
    #[inline(always)]
    fn normal_quantile(self) -> Self {
        normal_quantile_f32(self)
    }
    #[inline(always)]
    fn normal_cdf(self) -> Self {
        normal_cdf_f32(self)
    }
}

impl Real for f64 {
    shared_items!(f64, glam::DVec3);

    #[inline]
    fn from_f64(value: f64) -> Self {
        value
    }
    #[inline]
    fn to_f64(self) -> f64 {
        self
    }
    #[inline]
    fn sin(self) -> Self {
        libm::sin(self)
    }
    #[inline]
    fn log2(self) -> Self {
        libm::log2(self)
    }
    #[inline]
    fn exponent_and_log2(self) -> (i32, Self) {
        let (half_mantissa, exponent) = libm::frexp(self);
        (exponent - 1, libm::log2(2.0 * half_mantissa))
    }
    #[inline]
    fn exp2(self) -> Self {
        libm::exp2(self)
    }
    #[inline]
    fn normal_quantile(self) -> Self {
        normal_quantile(Real::clamp(self, QUANTILE_EDGE, 1.0 - QUANTILE_EDGE))
    }
    #[inline]
    fn normal_cdf(self) -> Self {
        normal_cdf(self)
    }
}

/// Returns the floor of a number of a magnitude below [`Real::SMALL`], 0 for minus zero; any number elsewhere, NaN for NaN.
#[inline(always)]
pub(super) fn floor_of_small<R: Real>(x: R) -> R {
    let nearest = x.nearest();
    if nearest > x { nearest - R::from_f64(1.0) } else { nearest }
}

/// Returns two to a whole power, exactly; 0 below and infinity above the range of `f64`.
///
/// A general exponential takes ten times as long for the same bits.
#[inline]
#[must_use]
pub fn power_of_two(exponent: i32) -> f64 {
    match exponent {
        -1022..=1023 => f64::from_bits(((exponent + 1023) as u64) << 52),
        _ => libm::exp2(f64::from(exponent)),
    }
}

/// The largest |x| for which [`sin_f32`] takes its own polynomial, and up to which it is proved correctly rounded.
pub const SIN_F32_DOMAIN: f32 = 16_777_216.0;

/// Returns the sine of `x` radians, correctly rounded for |x| <= [`SIN_F32_DOMAIN`].
///
/// The argument is counted in half-turns in `f64`: the first factor has 29 bits, so its product with an `f32` is
/// exact, and so is the difference to the nearest integer; a second factor adds the rest of 1/pi. An odd polynomial
/// of degree 15 then gives sin(pi f), and the parity of the integer its sign. Beyond the domain the value is the
/// `f64` sine rounded to `f32`, which is portable but not proved. `sin_f32(-0.0)` is -0.0; NaN and the infinities
/// give NaN.
///
/// Not in the paper: GLSL and WGSL leave the accuracy of `sin` at such arguments open.
#[must_use]
pub fn sin_f32(x: f32) -> f32 {
    if x.abs() <= SIN_F32_DOMAIN { sin_in_domain::<false>(x) } else { libm::sin(f64::from(x)) as f32 }
}

/// Coefficients of the odd polynomial of degree 15 for sin(pi f), f in [-1/2, 1/2].
pub(super) const SINE_OF_HALF_TURNS: [f64; 8] = [
    f64::from_bits(0x4009_21fb_5444_2d16),
    f64::from_bits(0xc014_abbc_e625_bd40),
    f64::from_bits(0x4004_66bc_6775_0710),
    f64::from_bits(0xbfe3_2d2c_ce14_bd2c),
    f64::from_bits(0x3fb5_0783_2391_fc0f),
    f64::from_bits(0xbf7e_3061_dc9d_6e7a),
    f64::from_bits(0x3f3e_89bd_5885_1811),
    f64::from_bits(0xbef6_24e8_9f86_3665),
];

/// [`sin_f32`] for |x| <= [`SIN_F32_DOMAIN`], without a branch; any number for other arguments.
///
/// `FUSED` lets a product enter a sum unrounded, where the machine has that as one instruction. The `f64` in between
/// differs then, the `f32` does not: both ways are correctly rounded, by exhaustion.
#[inline(always)]
pub(super) fn sin_in_domain<const FUSED: bool>(x: f32) -> f32 {
    /// The leading 29 bits of 1/pi.
    const HALF_TURNS_HIGH: f64 = f64::from_bits(0x3fd4_5f30_6e00_0000);
    /// 1/pi less its leading 29 bits.
    const HALF_TURNS_LOW: f64 = f64::from_bits(0xbdeb_1bbe_ad60_3d8b);
    /// Adding and subtracting 1.5 * 2^52 rounds to the nearest integer, which the low bits of the sum then hold.
    const TO_INTEGER: f64 = 6_755_399_441_055_744.0;
    let wide = f64::from(x);
    let half_turns = wide * HALF_TURNS_HIGH;
    let shifted = half_turns + TO_INTEGER;
    let rest = multiply_add::<FUSED>(wide, HALF_TURNS_LOW, half_turns - (shifted - TO_INTEGER));
    let sine = rest * horner::<FUSED, 8>(rest * rest, &SINE_OF_HALF_TURNS);
    let odd = shifted.to_bits() << 63;
    let sine = f64::from_bits(sine.to_bits() ^ odd) as f32;
    // The reduction loses the sign of zero.
    if x == 0.0 { x } else { sine }
}

/// Returns the logarithm of `x` to base two, correctly rounded for every `x`.
///
/// Computed in `f64` as `e + s P(s^2)` with `x = 2^e m`, `m` in [sqrt(1/2), sqrt 2) and `s = (m - 1)/(m + 1)`; exact
/// at every power of two, subnormal ones too. `log2_f32(0.0)` is -inf, a negative argument or NaN gives NaN.
///
/// Not in the paper: GLSL and WGSL allow 3 ULP here.
#[must_use]
pub fn log2_f32(x: f32) -> f32 {
    log2_everywhere::<false>(x)
}

/// [`log2_f32`] without a branch; `FUSED` as in [`sin_in_domain`].
#[inline(always)]
pub(super) fn log2_everywhere<const FUSED: bool>(x: f32) -> f32 {
    /// Brings a subnormal number into the normal range.
    const LIFT: f32 = 16_777_216.0;
    let subnormal = x < f32::MIN_POSITIVE;
    let (lifted, exponent) = if subnormal { (x * LIFT, -24) } else { (x, 0) };
    let log = log2_of_normal::<FUSED>(lifted, exponent);
    let finite = x > 0.0 && x < f32::INFINITY;
    let special = if x == 0.0 {
        f32::NEG_INFINITY
    } else if x > 0.0 {
        x
    } else {
        f32::NAN
    };
    if finite { log } else { special }
}

/// Returns the logarithm of `x` 2^`exponent` to base two for a positive normal `x`; `FUSED` as in [`sin_in_domain`].
#[inline(always)]
pub(super) fn log2_of_normal<const FUSED: bool>(x: f32, exponent: i32) -> f32 {
    /// The smallest `f32` above sqrt(1/2).
    const SQRT_HALF_BITS: u32 = 0x3f35_04f4;
    let bits = x.to_bits();
    let shift = (bits.wrapping_sub(SQRT_HALF_BITS) as i32) >> 23;
    let m = f64::from(f32::from_bits(bits.wrapping_sub((shift << 23) as u32)));
    log2_near_one::<FUSED>(m, f64::from(shift + exponent)) as f32
}

/// Returns the logarithm of `m` to base two plus `exponent`, for `m` in [sqrt(1/2), sqrt 2); `FUSED` as in [`sin_in_domain`].
#[inline(always)]
pub(super) fn log2_near_one<const FUSED: bool>(m: f64, exponent: f64) -> f64 {
    const COEFFICIENTS: [f64; 9] = [
        f64::from_bits(0x4007_1547_652b_82fe),
        f64::from_bits(0x3fee_c709_dc3a_03fc),
        f64::from_bits(0x3fe2_776c_50ef_9fcc),
        f64::from_bits(0x3fda_6176_2a70_85b9),
        f64::from_bits(0x3fd4_84b1_4487_386e),
        f64::from_bits(0x3fd0_c9a5_991b_72d8),
        f64::from_bits(0x3fcc_6a29_79e0_3137),
        f64::from_bits(0x3fc8_7740_3989_7f75),
        f64::from_bits(0x3fc8_7d8e_bae9_9ae1),
    ];
    let s = (m - 1.0) / (m + 1.0);
    multiply_add::<FUSED>(s, horner::<FUSED, 9>(s * s, &COEFFICIENTS), exponent)
}

/// Returns two to the power of `x`, correctly rounded for every `x`; 0 below and infinity above the range of `f32`.
///
/// The `f64` value of libm rounded to `f32` is wrong for two arguments of all; they are listed.
///
/// Not in the paper: WGSL allows 3 + 2|x| ULP here.
#[inline]
#[must_use]
pub fn exp2_f32(x: f32) -> f32 {
    // Those of octaves need no more than an exponent.
    if x.abs() <= 126.0 && x.nearest() == x {
        f32::from_bits((x.to_word().wrapping_add(127)) << 23)
    } else {
        exp2_anywhere(x)
    }
}

fn exp2_anywhere(x: f32) -> f32 {
    match x.to_bits() {
        0x3b42_9d37 => f32::from_bits(0x3f80_4385),
        0xbcf3_a937 => f32::from_bits(0x3f7a_c6b1),
        _ => libm::exp2(f64::from(x)) as f32,
    }
}

/// Evaluates `c0 + x (c1 + x (c2 + ...))`; `FUSED` as in [`sin_in_domain`].
#[inline(always)]
pub(super) fn horner<const FUSED: bool, const N: usize>(x: f64, coefficients: &[f64; N]) -> f64 {
    let mut sum = coefficients[N - 1];
    for &coefficient in coefficients[..N - 1].iter().rev() {
        sum = multiply_add::<FUSED>(sum, x, coefficient);
    }
    sum
}

#[inline(always)]
fn multiply_add<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// Returns the Euclidean length, summed from left to right (GLSL's `length`).
#[inline(always)]
pub(crate) fn length_of<R: Real>(v: [R; 3]) -> R {
    square_of(v).sqrt()
}

/// Returns the square of the Euclidean length, summed from left to right.
#[inline(always)]
pub(crate) fn square_of<R: Real>([x, y, z]: [R; 3]) -> R {
    x * x + y * y + z * z
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fract_counts_up_from_the_floor() {
        assert_eq!(Real::fract(-0.25_f32), 0.75);
        assert_eq!(Real::fract(2.5_f64), 0.5);
        assert_eq!(Real::fract(-1.0e-9_f32), 1.0);
    }

    #[test]
    fn floors_are_those_of_the_standard_library() {
        let edges =
            [0.0, 0.5, 1.0, 1.5, 4_194_303.5, 8_388_607.5, 8_388_608.0, 1.0e20, 1.0e-40, f32::INFINITY];
        let near = edges.into_iter().flat_map(|x| [x, x.next_up(), x.next_down()]);
        for x in near.flat_map(|x| [x, -x]).filter(|x| !x.is_nan()) {
            assert_eq!(Real::floor(x).to_bits(), x.floor().to_bits(), "{x:e}");
            for x in
                [f64::from(x), f64::from(x) * 536_870_912.0, f64::from(x).next_up(), f64::from(x).next_down()]
            {
                assert_eq!(Real::floor(x).to_bits(), x.floor().to_bits(), "{x:e}");
            }
        }
        assert!(Real::floor(f32::NAN).is_nan() && Real::floor(f64::NAN).is_nan());
        for bits in (0..=u32::MAX).step_by(65_521) {
            let x = f32::from_bits(bits);
            assert!(x.is_nan() || Real::floor(x).to_bits() == x.floor().to_bits(), "{x:e}");
            assert!(x.is_nan() || Real::ceil(x).to_bits() == x.ceil().to_bits(), "{x:e}");
        }
    }

    #[test]
    fn min_max_and_clamp_are_those_of_glsl() {
        assert!(Real::max(-0.0_f32, 0.0).is_sign_negative() && Real::min(-0.0_f32, 0.0).is_sign_negative());
        assert!(Real::max(f32::NAN, 1.0).is_nan());
        assert_eq!(Real::max(1.0, f32::NAN), 1.0);
        assert!(Real::clamp(f64::NAN, 0.0, 1.0).is_nan());
        assert_eq!(Real::clamp(-3.0_f64, 1.0e-6, 1.0), 1.0e-6);
    }

    #[test]
    fn logarithm_and_power_are_exact_at_powers_of_two() {
        for exponent in [-5000, -1075, -1074, -1023, -1022, 0, 1023, 1024, 5000] {
            assert_eq!(power_of_two(exponent), libm::exp2(f64::from(exponent)));
        }
        for exponent in -149..128 {
            let power = power_of_two(exponent) as f32;
            assert_eq!(log2_f32(power), exponent as f32);
            assert_eq!(exp2_f32(exponent as f32), power);
        }
        for exponent in -1022..1024 {
            let power = power_of_two(exponent);
            assert_eq!(Real::log2(power), f64::from(exponent));
            assert_eq!(Real::exp2(f64::from(exponent)), power);
        }
    }

    #[test]
    fn special_arguments() {
        assert_eq!(sin_f32(-0.0).to_bits(), (-0.0_f32).to_bits());
        assert!(sin_f32(f32::INFINITY).is_nan() && sin_f32(f32::NAN).is_nan());
        assert_eq!(log2_f32(0.0), f32::NEG_INFINITY);
        assert_eq!(log2_f32(-0.0), f32::NEG_INFINITY);
        assert_eq!(log2_f32(f32::INFINITY), f32::INFINITY);
        assert!(log2_f32(-1.0).is_nan() && log2_f32(f32::NAN).is_nan());
        assert_eq!(exp2_f32(128.0), f32::INFINITY);
        assert_eq!(exp2_f32(-151.0), 0.0);
    }

    #[test]
    fn to_word_is_twos_complement() {
        assert_eq!((-1.0_f32).to_word(), u32::MAX);
        assert_eq!(4_294_967_296.0_f64.to_word(), 0);
        assert_eq!(f32::NAN.to_word(), 0);
    }
}
