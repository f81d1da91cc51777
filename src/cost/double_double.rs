//! The paper's hash in double-double arithmetic: what its formula gives as a real number.
//!
//! A number is the unevaluated sum of two `f64`, 106 bits together. The hash multiplies the error of its first level by
//! 1.7e5 in the second, so that `f64` is off by 2^-10 in every fifth threshold of wide scenes; with 106 bits 15 digits
//! are left. Errors of the arithmetic follow Dekker (1971) and Knuth (TAOCP 2, 4.2.2).

use crate::threshold::hash::{Cell, Hash};
use crate::threshold::real::Real;
use core::ops::{Add, Mul, Neg, Sub};

/// The sum of two `f64`, the second below half a unit in the last place of the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// Wraps an exact value.
    #[must_use]
    pub const fn new(high: f64) -> Self {
        Self { high, low: 0.0 }
    }

    /// Rounds to the nearest `f64`.
    #[must_use]
    pub const fn to_f64(self) -> f64 {
        self.high
    }

    const fn of_bits([high, low]: [u64; 2]) -> Self {
        Self { high: f64::from_bits(high), low: f64::from_bits(low) }
    }

    /// Adds two numbers of which the first is the larger one, exactly.
    fn quick_sum(high: f64, low: f64) -> Self {
        let sum = high + low;
        Self { high: sum, low: low - (sum - high) }
    }

    /// Adds two numbers exactly.
    fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let of_b = high - a;
        Self { high, low: (a - (high - of_b)) + (b - of_b) }
    }

    /// Multiplies two numbers exactly.
    fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self { high, low: a.mul_add(b, -high) }
    }

    fn floor(self) -> Self {
        let high = self.high.floor();
        if high == self.high { Self::quick_sum(high, self.low.floor()) } else { Self::new(high) }
    }

    fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// Returns the sine of an angle in radians; |x| up to 2^30 with an absolute error below 2^-100 |x|.
    #[must_use]
    pub fn sin(self) -> Self {
        let half_turns = (self.high * core::f64::consts::FRAC_1_PI).round();
        let rest = PI
            .into_iter()
            .map(f64::from_bits)
            .fold(self, |rest, part| rest - Self::product(half_turns, part));
        let squared = rest * rest;
        let [others @ .., last] = &SERIES;
        let series =
            others.iter().rev().fold(Self::of_bits(*last), |sum, &term| sum * squared + Self::of_bits(term));
        let sine = rest * series;
        if half_turns as i64 & 1 == 0 { sine } else { -sine }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, low) = (Self::sum(self.high, other.high), Self::sum(self.low, other.low));
        let carried = Self::quick_sum(high.high, high.low + low.high);
        Self::quick_sum(carried.high, carried.low + low.low)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        Self::quick_sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

/// Pi in three parts, 159 bits.
const PI: [u64; 3] = [0x4009_21fb_5444_2d18, 0x3ca1_a626_3314_5c07, 0xb92f_1976_b7ed_8fbc];

/// One tenth, which no binary number is.
const TENTH: [u64; 2] = [0x3fb9_9999_9999_999a, 0xbc59_9999_9999_999a];

/// The series of sin(x)/x in the square of x, up to x^34: the next term is below 2^-113 at a quarter-turn.
const SERIES: [[u64; 2]; 18] = [
    [0x3ff0_0000_0000_0000, 0x0000_0000_0000_0000],
    [0xbfc5_5555_5555_5555, 0xbc65_5555_5555_5555],
    [0x3f81_1111_1111_1111, 0x3c01_1111_1111_1111],
    [0xbf2a_01a0_1a01_a01a, 0xbb6a_01a0_1a01_a01a],
    [0x3ec7_1de3_a556_c734, 0xbb6c_154f_8ddc_6c00],
    [0xbe5a_e645_67f5_44e4, 0x3afc_062e_06d1_f209],
    [0x3de6_1246_13a8_6d09, 0x3a8f_28e0_cc74_8ebe],
    [0xbd6a_e7f3_e733_b81f, 0xb9e1_d865_6b0e_e8cb],
    [0x3ce9_52c7_7030_ad4a, 0x398a_c981_465d_dc6c],
    [0xbc62_f49b_4681_4157, 0xb8f2_650f_61db_dcb4],
    [0x3bd7_1b8e_f6dc_f572, 0xb87d_043a_e40c_4647],
    [0xbb47_61b4_1316_381a, 0x37d3_423c_7d91_404f],
    [0x3ab3_f3cc_dd16_5fa9, 0xb745_8dda_df34_4487],
    [0xba1d_1ab1_c2dc_cea3, 0xb6a0_54d0_c78a_ea14],
    [0x3982_59f9_8b43_58ad, 0x362e_af8c_39dd_9bc5],
    [0xb8e4_34d2_e783_f5bc, 0xb580_b87b_91be_9aff],
    [0x3843_9812_54dd_0d52, 0xb4e2_b1f4_c801_5a2f],
    [0xb7a0_dc59_c716_d91f, 0xb434_19e3_fad3_f031],
];

/// Hashes two coordinates as [`hash_2d`](crate::threshold::hash::sine::hash_2d) does, with exact constants.
fn hash_2d(x: DoubleDouble, y: DoubleDouble) -> DoubleDouble {
    let (number, tenth) = (DoubleDouble::new, DoubleDouble::of_bits(TENTH));
    let amplitude = number(1.0e4) * (number(17.0) * x + tenth * y).sin();
    let value = amplitude * (tenth + (number(13.0) * y + x).sin().abs());
    value - value.floor()
}

/// The paper's `hash3D` as a function of real numbers (§5.1), rounded once at the end.
#[derive(Clone, Copy, Debug, Default)]
pub struct RealSine;

impl<R: Real> Hash<R> for RealSine {
    fn hash(&self, cell: &Cell<R>) -> R {
        let index: [R; 3] = cell.index.into();
        let [x, y, z] = index.map(|i| DoubleDouble::new(i.to_f64()));
        R::from_f64(hash_2d(hash_2d(x, y), z).to_f64())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threshold::hash::sine::Sine;

    fn cell([x, y, z]: [i32; 3]) -> Cell<f64> {
        Cell { index: glam::DVec3::new(x.into(), y.into(), z.into()), octave: 0 }
    }

    /// Values from mpmath with 400 bits.
    #[test]
    fn the_hash_agrees_with_a_high_precision_evaluation() {
        for (at, expected) in [
            ([1, 0, 0], 0.12764896761109399518),
            ([3, -5, 7], 0.17698636873036387022),
            ([40000, -12345, 31], 0.26218543593390309674),
            ([-39999, 20001, -37777], 0.69529962800710618278),
            ([65536, 65535, -65534], 0.37685065102505192159),
        ] {
            let value = RealSine.hash(&cell(at));
            assert!((value - expected).abs() < 1e-13, "{at:?}: {value}, not {expected}");
        }
        // The same in f64 is not that good.
        let far = cell([65_536, 65_535, -65_534]);
        assert!((Sine.hash(&far) - RealSine.hash(&far)).abs() > 1e-9);
    }

    #[test]
    fn the_sine_has_a_hundred_bits() {
        for (x, bits) in [
            (1.0, [0x3fea_ed54_8f09_0cee, 0x3c40_6374_f484_e288]),
            (-2.5, [0xbfe3_26af_0dcf_cab1, 0x3c8f_d427_3416_1659]),
            (696969.5, [0x3fe8_cc49_30d4_328d, 0xbc8d_3592_8a89_2423]),
            (-123456.75, [0x3fef_ff56_feed_772b, 0xbc81_0b18_77d9_839b]),
        ] {
            let (sine, expected) = (DoubleDouble::new(x).sin(), DoubleDouble::of_bits(bits));
            let error = (sine - expected).to_f64().abs();
            assert!(error < libm::exp2(-100.0) * x.abs().max(1.0), "{x}: {error:e}");
            assert_eq!(sine.high, expected.high);
        }
    }
}
