//! The listings under another arithmetic: models of what a GPU may make of the same `f32` source.
//!
//! Not in the paper. [`Emulated`] implements [`Real`] for any [`Arithmetic`], so every listing, hash and repair runs
//! under it unchanged. These are models of what the shading languages permit, not measurements of a device.
//!
//! | model | what it permits itself |
//! |---|---|
//! | [`Single`] | nothing: the reference |
//! | [`CoarseSine`] | a sine no better than WGSL demands: an absolute error of 2^-11 |
//! | [`ReducedSine`] | a sine that first multiplies its argument by 1/(2 pi), rounded to `f32` |
//! | [`Half`] | `mediump`: every operation is rounded to IEEE binary16 |
//! | [`FlushToZero`] | subnormal results are replaced by zero |
//! | [`Fused`] | a product that is added to or subtracted from something is not rounded before |

use super::normal::{normal_cdf_f32, normal_quantile_f32};
use super::real::{Real, exp2_f32, log2_f32, sealed::Sealed, sin_f32};
use core::cmp::Ordering;
use core::fmt::{self, Debug, Display};
use core::marker::PhantomData;
use core::num::ParseFloatError;
use core::ops::{Add, Div, Mul, Neg, Sub};
use core::str::FromStr;

/// What an arithmetic does differently from `f32`. Implement it to put an arithmetic of your own on trial.
///
/// ```
/// use hashed_alpha::threshold::emulated::{Arithmetic, Emulated};
/// use hashed_alpha::threshold::{hash::sine::hash_2d, real::Real};
///
/// /// A sine that answers from a table of 256 values a turn.
/// #[derive(Clone, Copy, Debug, Default)]
/// struct Table;
/// impl Arithmetic for Table {
///     const NAME: &'static str = "table";
///     fn sin(x: f32) -> f32 {
///         const STEP: f32 = core::f32::consts::TAU / 256.0;
///         ((x / STEP).floor() * STEP).sin()
///     }
/// }
/// let [x, y] = [3.0, 5.0].map(Emulated::<Table>::from_f64);
/// assert!(hash_2d(x, y).to_f64() < 1.0);
/// ```
pub trait Arithmetic: Copy + Debug + Default + Send + Sync + 'static {
    /// The name in tables and figures.
    const NAME: &'static str;

    /// Exponent of the largest power of two.
    const MAX_EXPONENT: i32 = <f32 as Real>::MAX_EXPONENT;

    /// Whether a product that is added to or subtracted from something is rounded only after that.
    const FUSES: bool = false;

    /// Rounds a result of 53 bits to what the arithmetic can hold.
    ///
    /// 53 bits are more than twice 24 and two, so that rounding the `f64` sum, product, quotient or root of two `f32`
    /// once more gives the correctly rounded `f32`; for narrower types all the more.
    #[must_use]
    fn round(exact: f64) -> f32 {
        exact as f32
    }

    /// Returns the sine of an angle in radians.
    #[must_use]
    fn sin(x: f32) -> f32 {
        sin_f32(x)
    }

    /// Returns the cosine of an angle in radians; no listing takes one, but a shader may.
    #[must_use]
    fn cos(x: f32) -> f32 {
        libm::cos(f64::from(x)) as f32
    }
}

/// IEEE `f32` itself, with the reference sine.
#[derive(Clone, Copy, Debug, Default)]
pub struct Single;

impl Arithmetic for Single {
    const NAME: &'static str = "accurate";
}

/// A sine with the least accuracy that WGSL permits.
///
/// The correctly rounded sine, rounded once more to a multiple of 2^-10: the absolute error is at most 2^-11, which
/// WGSL demands on [-pi, pi]. Outside, where WGSL demands nothing, the model keeps that error at every argument, as if
/// the reduction to one turn were exact.
#[derive(Clone, Copy, Debug, Default)]
pub struct CoarseSine;

impl Arithmetic for CoarseSine {
    const NAME: &'static str = "coarse sine";
    fn sin(x: f32) -> f32 {
        (sin_f32(x) * 1024.0).round_ties_even() / 1024.0
    }
    fn cos(x: f32) -> f32 {
        (Single::cos(x) * 1024.0).round_ties_even() / 1024.0
    }
}

/// A sine that multiplies its argument by 1/(2 pi), rounded to `f32`, and takes the sine of the fraction of a turn.
///
/// Exact but for that reduction, whose error grows with the argument: the angle is off by 2^-24 of itself.
#[derive(Clone, Copy, Debug, Default)]
pub struct ReducedSine;

impl Arithmetic for ReducedSine {
    const NAME: &'static str = "reduced sine";
    fn sin(x: f32) -> f32 {
        sin_f32(Self::reduced(x))
    }
    fn cos(x: f32) -> f32 {
        Single::cos(Self::reduced(x))
    }
}

impl ReducedSine {
    fn reduced(x: f32) -> f32 {
        let turns = x * (1.0 / core::f32::consts::TAU);
        Real::fract(turns) * core::f32::consts::TAU
    }
}

/// IEEE binary16: 11 significant bits, 65504 at most, subnormal steps of 2^-24.
#[derive(Clone, Copy, Debug, Default)]
pub struct Half;

impl Arithmetic for Half {
    const NAME: &'static str = "half";
    const MAX_EXPONENT: i32 = 15;
    fn round(exact: f64) -> f32 {
        /// Halfway between the largest number and the next power of two, which rounds to even: upwards.
        const OVERFLOW: f64 = 65_520.0;
        const SMALLEST_NORMAL: f64 = 1.0 / 16_384.0;
        let magnitude = exact.abs();
        let rounded = if magnitude >= OVERFLOW {
            f64::INFINITY
        } else if magnitude < SMALLEST_NORMAL {
            (magnitude * 16_777_216.0).round_ties_even() / 16_777_216.0
        } else if magnitude.is_nan() {
            magnitude
        } else {
            // Ten bits stay after the leading one: the number is a whole multiple of its exponent's 2^-10.
            let step = f64::from_bits(magnitude.to_bits() & f64::INFINITY.to_bits()) / 1024.0;
            (magnitude / step).round_ties_even() * step
        };
        rounded.copysign(exact) as f32
    }
    fn sin(x: f32) -> f32 {
        Self::round(f64::from(sin_f32(x)))
    }
}

/// Subnormal results become zero of the same sign.
#[derive(Clone, Copy, Debug, Default)]
pub struct FlushToZero;

impl Arithmetic for FlushToZero {
    const NAME: &'static str = "flush to zero";
    fn round(exact: f64) -> f32 {
        let rounded = exact as f32;
        if rounded.is_subnormal() { 0.0_f32.copysign(rounded) } else { rounded }
    }
    fn sin(x: f32) -> f32 {
        Self::round(f64::from(sin_f32(x)))
    }
}

/// Contraction: `a * b + c` is one operation with one rounding; of two products the left one stays exact.
///
/// Builtin functions, `fract` among them, are given rounded arguments.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fused;

impl Arithmetic for Fused {
    const NAME: &'static str = "fused";
    const FUSES: bool = true;
}

/// A number of another arithmetic; every `f32` operation is followed by the rounding of `A`.
///
/// ```
/// use hashed_alpha::threshold::emulated::{Emulated, Half};
/// use hashed_alpha::threshold::{hash::sine::hash_2d, real::Real};
///
/// // In half precision the amplitude of the hash has no fractional part.
/// let [x, y] = [31.0, 7.0].map(Emulated::<Half>::from_f64);
/// assert_eq!(hash_2d(x, y).to_f64(), 0.0);
/// ```
#[derive(Clone, Copy, Default)]
pub struct Emulated<A> {
    value: f32,
    /// The factors of a product that may still enter a sum unrounded.
    factors: Option<[f32; 2]>,
    arithmetic: PhantomData<A>,
}

impl<A: Arithmetic> Emulated<A> {
    /// Rounds a result to the arithmetic.
    fn rounded(exact: f64) -> Self {
        Self::held(A::round(exact))
    }

    /// Wraps a value that the arithmetic can hold.
    fn held(value: f32) -> Self {
        Self { value, factors: None, arithmetic: PhantomData }
    }

    fn wide(self) -> f64 {
        f64::from(self.value)
    }
}

impl<A: Arithmetic> Add for Emulated<A> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        match (self.factors, other.factors) {
            (Some([a, b]), _) => Self::held(a.mul_add(b, other.value)),
            (None, Some([a, b])) => Self::held(a.mul_add(b, self.value)),
            (None, None) => Self::rounded(self.wide() + other.wide()),
        }
    }
}

impl<A: Arithmetic> Sub for Emulated<A> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<A: Arithmetic> Mul for Emulated<A> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let factors = A::FUSES.then_some([self.value, other.value]);
        Self { factors, ..Self::rounded(self.wide() * other.wide()) }
    }
}

impl<A: Arithmetic> Div for Emulated<A> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Self::rounded(self.wide() / other.wide())
    }
}

impl<A: Arithmetic> Neg for Emulated<A> {
    type Output = Self;
    fn neg(self) -> Self {
        Self { factors: self.factors.map(|[a, b]| [-a, b]), ..Self::held(-self.value) }
    }
}

impl<A> PartialEq for Emulated<A> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<A> PartialOrd for Emulated<A> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<A> Debug for Emulated<A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Debug::fmt(&self.value, f)
    }
}

impl<A> Display for Emulated<A> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Display::fmt(&self.value, f)
    }
}

impl<A: Arithmetic> FromStr for Emulated<A> {
    type Err = ParseFloatError;
    fn from_str(text: &str) -> Result<Self, ParseFloatError> {
        text.parse().map(Self::rounded)
    }
}

impl<A: Arithmetic> Sealed for Emulated<A> {}

impl<A: Arithmetic> Real for Emulated<A> {
    type Vec3 = [Self; 3];

    const NAME: &'static str = A::NAME;
    const MAX_EXPONENT: i32 = A::MAX_EXPONENT;

    fn from_f64(value: f64) -> Self {
        Self::rounded(value)
    }
    fn to_f64(self) -> f64 {
        self.wide()
    }
    fn to_word(self) -> u32 {
        self.value.to_word()
    }
    fn small_word(self) -> u32 {
        self.value.small_word()
    }
    fn to_i32(self) -> i32 {
        self.value.to_i32()
    }
    const SMALL: Self = Self { value: <f32 as Real>::SMALL, factors: None, arithmetic: PhantomData };
    fn nearest(self) -> Self {
        Self::held(self.value.round_ties_even())
    }
    fn floor(self) -> Self {
        Self::held(self.value.floor())
    }
    fn ceil(self) -> Self {
        Self::held(self.value.ceil())
    }
    fn abs(self) -> Self {
        Self::held(self.value.abs())
    }
    fn sqrt(self) -> Self {
        Self::rounded(self.wide().sqrt())
    }
    fn sin(self) -> Self {
        Self::held(A::sin(self.value))
    }
    fn log2(self) -> Self {
        Self::rounded(f64::from(log2_f32(self.value)))
    }
    fn exponent_and_log2(self) -> (i32, Self) {
        let (exponent, log) = self.value.exponent_and_log2();
        (exponent, Self::rounded(f64::from(log)))
    }
    fn exp2(self) -> Self {
        Self::rounded(f64::from(exp2_f32(self.value)))
    }
    fn normal_quantile(self) -> Self {
        Self::rounded(f64::from(normal_quantile_f32(self.value)))
    }
    fn normal_cdf(self) -> Self {
        Self::rounded(f64::from(normal_cdf_f32(self.value)))
    }
    fn is_nan(self) -> bool {
        self.value.is_nan()
    }
    fn is_finite(self) -> bool {
        self.value.is_finite()
    }
    fn fract(self) -> Self {
        Self::rounded(self.wide() - self.wide().floor())
    }
}

#[cfg(test)]
mod tests {
    use super::super::hash::sine::hash_3d;
    use super::*;

    #[test]
    fn the_wrapper_alone_changes_no_bit() {
        for x in -60..60 {
            for y in -60..60 {
                let cell = [f64::from(x) * 1237.0, f64::from(y) * 0.37, f64::from(x - y)];
                let plain = hash_3d::<f32>(cell.map(|c| c as f32).into());
                let wrapped = hash_3d::<Emulated<Single>>(cell.map(Emulated::from_f64));
                assert_eq!(wrapped.value.to_bits(), plain.to_bits(), "{cell:?}");
            }
        }
    }

    #[test]
    fn a_product_enters_a_sum_unrounded_only_where_it_is_fused() {
        fn rest<A: Arithmetic>() -> f64 {
            let x = Emulated::<A>::from_f64(1.0 + 1.0 / 8192.0);
            (x * x - Emulated::from_f64((x * x).to_f64())).to_f64()
        }
        assert_eq!(rest::<Single>(), 0.0);
        assert_eq!(rest::<Fused>(), 1.0 / 67_108_864.0);
    }

    #[test]
    fn half_precision_has_the_range_of_binary16() {
        let half = |x: f64| Emulated::<Half>::from_f64(x).to_f64();
        assert_eq!(half(65_519.9), 65_504.0);
        assert_eq!(half(-65_520.0), f64::NEG_INFINITY);
        assert_eq!(half(2049.0), 2048.0);
        assert_eq!(half(2051.0), 2052.0);
        assert_eq!(half(0.1), 0.0999755859375);
        assert_eq!(half(libm::exp2(-25.0)), 0.0);
        assert_eq!(half(libm::exp2(-24.0) * 0.51), libm::exp2(-24.0));
        assert!(half(f64::NAN).is_nan());
    }

    #[test]
    fn subnormal_results_are_flushed() {
        let tiny = Emulated::<FlushToZero>::from_f64(f64::from(f32::MIN_POSITIVE));
        assert_eq!((tiny * Emulated::from_f64(0.5)).to_f64(), 0.0);
        assert_eq!(tiny.to_f64(), f64::from(f32::MIN_POSITIVE));
    }

    #[test]
    fn the_coarse_sine_stays_within_its_bound() {
        let worst = (-4096..=4096)
            .map(|i| i as f32 * (core::f32::consts::PI / 4096.0))
            .map(|x| (CoarseSine::sin(x) - sin_f32(x)).abs())
            .fold(0.0, f32::max);
        assert!(worst <= 1.0 / 2048.0 && worst > 0.9 / 2048.0, "{worst}");
    }
}
