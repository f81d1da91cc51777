//! The law of `(1 - t) U0 + t U1`, two independent uniforms joined with weight t = `lerpFactor` (Eq. 2).
//!
//! The density is a symmetric trapezoid on [0, 1] that rises over [0, a] with `a = min(t, 1 - t)`. Its distribution
//! function, applied to the joined value, makes that value uniform again; leaving it out makes the variance of the
//! noise breathe with distance.

use super::choice::{UnknownName, by_name};
use super::real::Real;
use core::fmt;
use core::str::FromStr;

/// Which way of computing Eq. 2 is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CdfForm {
    /// As Listings 1 and 2 write it: [`cdf_literal`].
    Literal,
    /// Without a division by zero: [`cdf`].
    Stable,
}

impl CdfForm {
    /// Both forms.
    pub const ALL: [Self; 2] = [Self::Literal, Self::Stable];

    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Literal => "literal",
            Self::Stable => "stable",
        }
    }

    /// Evaluates Eq. 2 in this form.
    #[must_use]
    pub fn cdf<R: Real>(self, x: R, lerp_factor: R) -> R {
        match self {
            Self::Literal => cdf_literal(x, lerp_factor),
            Self::Stable => cdf(x, lerp_factor),
        }
    }
}

impl fmt::Display for CdfForm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for CdfForm {
    type Err = UnknownName;
    fn from_str(name: &str) -> Result<Self, UnknownName> {
        by_name("form of the CDF", &Self::ALL, Self::name, name)
    }
}

/// Returns `min(lerp_factor, 1 - lerp_factor)`, the paper's `a`, in [0, 1/2].
#[inline(always)]
#[must_use]
pub fn minor_weight<R: Real>(lerp_factor: R) -> R {
    Real::min(lerp_factor, R::from_f64(1.0) - lerp_factor)
}

/// Evaluates Eq. 2 at `x` in [0, 1], as Listings 1 and 2 write it.
///
/// `lerp_factor` in [0, 1]. NaN where it is 0 or 1 and `x` is 1: the third case then divides zero by zero. In `f32`
/// one step backwards of 1 ULP stands at the junction of the last two cases for `a` = 1/2 - 2^-25.
#[inline(always)]
#[must_use]
pub fn cdf_literal<R: Real>(x: R, lerp_factor: R) -> R {
    let [half, one, two] = [0.5, 1.0, 2.0].map(R::from_f64);
    let a = minor_weight(lerp_factor);
    let below = x < one - a;
    let from_edge = if below { x } else { one - x };
    let middle = below & (x >= a);
    // One division serves the three cases, without a branch that no predictor could foretell.
    let numerator = if middle { x - half * a } else { from_edge * from_edge };
    let divisor = if middle { one - a } else { two * a * (one - a) };
    let quotient = numerator / divisor;
    if below { quotient } else { one - quotient }
}

/// Evaluates Eq. 2 at `x` in [0, 1] without a division by zero.
///
/// `lerp_factor` in [0, 1]. For every such pair the value is in [0, 1], 0 at 0, 1 at 1 and non-decreasing in `x`:
/// each case divides only where its divisor is above a number that is not negative. Within 2^-23 of Eq. 2 in `f32`.
/// Not in the paper; equal to [`cdf_literal`] up to rounding.
#[inline(always)]
#[must_use]
pub fn cdf<R: Real>(x: R, lerp_factor: R) -> R {
    let [half, one] = [0.5, 1.0].map(R::from_f64);
    let a = minor_weight(lerp_factor);
    let from_top = one - x;
    let low = x < a;
    let edge = low | (from_top < a);
    let from_edge = if low { x } else { from_top };
    // Two divisions serve the three cases, without a branch that no predictor could foretell.
    let quotient = (if edge { from_edge / a } else { x - half * a }) / (one - a);
    let at_edge = half * from_edge * quotient;
    if !edge {
        quotient
    } else if low {
        at_edge
    } else {
        one - at_edge
    }
}

/// Returns the density of the law at `x`: a trapezoid of height `1 / (1 - a)` on [0, 1], 0 outside.
///
/// `lerp_factor` in [0, 1]. The derivative of Eq. 2.
#[must_use]
pub fn density<R: Real>(x: R, lerp_factor: R) -> R {
    let [zero, one] = [0.0, 1.0].map(R::from_f64);
    let a = minor_weight(lerp_factor);
    let from_edge = Real::min(x, one - x);
    if from_edge < zero {
        zero
    } else if from_edge < a {
        from_edge / (a * (one - a))
    } else {
        one / (one - a)
    }
}

/// Returns the `x` in [0, 1] at which Eq. 2 reaches `probability` in [0, 1].
///
/// `lerp_factor` in [0, 1]. The inverse of [`cdf`]; not in the paper.
#[must_use]
pub fn quantile<R: Real>(probability: R, lerp_factor: R) -> R {
    let [half, one, two] = [0.5, 1.0, 2.0].map(R::from_f64);
    let a = minor_weight(lerp_factor);
    let corner = half * a / (one - a);
    let from_top = one - probability;
    if probability < corner {
        (two * a * (one - a) * probability).sqrt()
    } else if from_top < corner {
        one - (two * a * (one - a) * from_top).sqrt()
    } else {
        (one - a) * probability + half * a
    }
}

/// The mean of the law for every weight.
pub const MEAN: f64 = 0.5;

/// Returns the variance of the law, `(1 - 2 a (1 - a)) / 12`: from 1/12 at weight 0 down to 1/24 at 1/2.
#[must_use]
pub fn variance<R: Real>(lerp_factor: R) -> R {
    let [one, two, twelve] = [1.0, 2.0, 12.0].map(R::from_f64);
    let a = minor_weight(lerp_factor);
    (one - two * a * (one - a)) / twelve
}

/// What leaving out Eq. 2 does to the threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OmissionEffect<R> {
    /// The largest distance between the law and U(0, 1), `a (1 - a) / 2`: the worst error in coverage.
    pub coverage_error: R,
    /// Cohen's w^2 of a chi-square test with ever finer bins, `a (2 - 3 a) / (3 (1 - a)^2)`.
    pub chi_square_effect: R,
}

/// Returns the effect of leaving out Eq. 2 at one weight. Not in the paper.
#[must_use]
pub fn omission_effect<R: Real>(lerp_factor: R) -> OmissionEffect<R> {
    let [half, one, two, three] = [0.5, 1.0, 2.0, 3.0].map(R::from_f64);
    let a = minor_weight(lerp_factor);
    OmissionEffect {
        coverage_error: half * a * (one - a),
        chi_square_effect: a * (two - three * a) / (three * (one - a) * (one - a)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WEIGHTS: [f64; 9] = [0.0, 1e-6, 0.1, 1.0 / 3.0, 0.5, 0.6, 0.75, 0.999, 1.0];

    fn steps() -> impl Iterator<Item = f64> {
        (0..=1000).map(|i| f64::from(i) / 1000.0)
    }

    #[test]
    fn literal_and_stable_agree_away_from_the_corner() {
        for weight in WEIGHTS {
            for x in steps().filter(|&x| x < 1.0) {
                let difference = cdf(x, weight) - cdf_literal(x, weight);
                assert!(difference.abs() < 4.0 * f64::EPSILON, "x {x}, weight {weight}: {difference}");
            }
        }
    }

    #[test]
    fn literal_is_nan_in_the_corner_and_stable_is_not() {
        assert!(cdf_literal(1.0_f32, 0.0).is_nan());
        assert_eq!(cdf(1.0_f32, 0.0), 1.0);
        assert_eq!(cdf(0.0_f32, 0.0), 0.0);
    }

    #[test]
    fn literal_steps_back_at_one_junction() {
        let a = 0.5 - libm::exp2(-25.0) as f32;
        let before = f32::from_bits(0.5_f32.to_bits() - 1);
        assert!(cdf_literal(before, a) > cdf_literal(0.5, a));
        assert!(cdf(before, a) <= cdf(0.5, a));
    }

    #[test]
    fn quantile_inverts_the_cdf() {
        for weight in WEIGHTS {
            for p in steps() {
                assert!((cdf(quantile(p, weight), weight) - p).abs() < 1e-14, "p {p}, weight {weight}");
            }
        }
    }

    #[test]
    fn density_is_the_slope_and_integrates_to_one() {
        let n = 200_000;
        for weight in [0.1, 0.4, 0.5, 0.8] {
            let midpoints = (0..n).map(|i| (f64::from(i) + 0.5) / f64::from(n));
            let (mut mass, mut second) = (0.0, 0.0);
            for x in midpoints {
                let mass_here = density(x, weight) / f64::from(n);
                mass += mass_here;
                second += (x - MEAN) * (x - MEAN) * mass_here;
            }
            assert!((mass - 1.0).abs() < 1e-9, "{mass}");
            assert!((second - variance(weight)).abs() < 1e-9, "{second}");
        }
    }

    #[test]
    fn omission_effect_is_the_distance_that_the_cdf_removes() {
        for weight in [0.05, 0.25, 0.5, 0.7] {
            let effect = omission_effect::<f64>(weight);
            let worst = steps().map(|x| (cdf(x, weight) - x).abs()).fold(0.0, f64::max);
            assert!((worst - effect.coverage_error).abs() < 1e-3, "{worst}");
            let n = 100_000;
            let w2 = (0..n)
                .map(|i| density((f64::from(i) + 0.5) / f64::from(n), weight) - 1.0)
                .map(|excess| excess * excess / f64::from(n))
                .sum::<f64>();
            assert!((w2 - effect.chi_square_effect).abs() < 1e-6, "{w2}");
        }
        assert!((omission_effect::<f64>(0.5).chi_square_effect - 1.0 / 3.0).abs() < 1e-15);
    }

    /// Values of Eq. 2 from exact rational arithmetic.
    #[test]
    fn golden_values() {
        for (x, weight, expected) in [
            (0.25, 0.5, 0.125),
            (0.5, 0.5, 0.5),
            (0.75, 0.5, 0.875),
            (0.125, 0.25, 1.0 / 24.0),
            (0.5, 0.25, 0.5),
            (0.9375, 0.75, 1.0 - 1.0 / 96.0),
            (0.3, 0.0, 0.3),
        ] {
            assert!((cdf::<f64>(x, weight) - expected).abs() <= f64::EPSILON, "x {x}, weight {weight}");
            assert!((cdf(x as f32, weight as f32) - expected as f32).abs() <= f32::EPSILON);
        }
    }
}
