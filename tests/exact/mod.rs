//! Double-double arithmetic: the unevaluated sum of two `f64`, 106 bits, relative errors below 2^-100.

use std::ops::{Add, Div, Mul, Sub};

/// A number as the sum of two `f64`, the second below half an ULP of the first.
#[derive(Clone, Copy, Debug)]
pub struct Exact {
    pub high: f64,
    pub low: f64,
}

impl From<f64> for Exact {
    fn from(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }
}

/// The sum of two numbers and what rounding took off it (Knuth).
fn two_sum(a: f64, b: f64) -> Exact {
    let high = a + b;
    let other = high - a;
    Exact { high, low: (a - (high - other)) + (b - other) }
}

impl Exact {
    pub fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::from(self.high.sqrt());
        }
        let root = self.high.sqrt();
        let rest = self - Self::from(root) * Self::from(root);
        two_sum(root, rest.high / (2.0 * root))
    }
}

impl Add for Exact {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, low) = (two_sum(self.high, other.high), two_sum(self.low, other.low));
        let middle = two_sum(high.high, high.low + low.high);
        two_sum(middle.high, middle.low + low.low)
    }
}

impl Sub for Exact {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + Self { high: -other.high, low: -other.low }
    }
}

impl Mul for Exact {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = self.high * other.high;
        let rest = self.high.mul_add(other.high, -product);
        two_sum(product, rest + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Exact {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - Self::from(first) * other;
        let second = rest.high / other.high;
        let rest = rest - Self::from(second) * other;
        two_sum(first, second) + Self::from(rest.high / other.high)
    }
}
