//! Closed forms for two thresholds that share the cell of one octave and not that of the other.
//!
//! Two points near each other lie in the same fine cell, and then have the same threshold, or in the same coarse cell
//! only, or in none. What is here is about the second case. None of it is in the paper; all of it assumes that hashes
//! of distinct cells are independent and uniform.

use crate::threshold::cdf::{minor_weight, quantile};
use crate::threshold::normal::normal_quantile;
use core::f64::consts::PI;

/// Returns the correlation of two thresholds of Eq. 2 at the same `lerp_factor` that share their coarse cell, in
/// [0, 1].
///
/// `lerp_factor` in [0, 1]. With F_a of Eq. 2 it is 12 Var(E[F_a | hash of the coarse cell]), a rational function of the
/// weight in each of three pieces; 103/210 at 1/2.
#[must_use]
pub fn interpolated_correlation(lerp_factor: f64) -> f64 {
    let a = minor_weight(lerp_factor);
    let b = 1.0 - a;
    let polynomial = |coefficients: &[f64]| coefficients.iter().rev().fold(0.0, |sum, &c| sum * a + c);
    if lerp_factor >= 0.5 {
        a * a * polynomial(&[210.0, -546.0, 355.0]) / (210.0 * b * b * b * b)
    } else if a <= 1.0 / 3.0 {
        polynomial(&[105.0, -315.0, 210.0, 52.0]) / (105.0 * b * b * b)
    } else {
        polynomial(&[1.0, -21.0, 189.0, -945.0, 3045.0, -5733.0, 5523.0, -2083.0])
            / (210.0 * a * a * a * a * b * b * b)
    }
}

/// Returns the probability that two thresholds of Eq. 2 at the same `lerp_factor` that share their coarse cell are both
/// at most `alpha`, in [0, `alpha`].
///
/// `lerp_factor` in [0, 1), `alpha` in [0, 1]. Given the coarse hash the two are independent; the square of what is
/// left to the fine one is integrated over it.
#[must_use]
pub fn interpolated_joint_visibility(lerp_factor: f64, alpha: f64) -> f64 {
    let (coarse, fine) = (1.0 - lerp_factor, lerp_factor);
    let x = quantile(alpha, lerp_factor);
    if fine == 0.0 {
        return alpha;
    }
    // Below `certain` every fine hash keeps the fragment, above `possible` none does.
    let certain = ((x - fine) / coarse).clamp(0.0, 1.0);
    let possible = (x / coarse).clamp(0.0, 1.0);
    let kept = |hash: f64| ((x - coarse * hash) / fine).clamp(0.0, 1.0);
    let (first, last) = (kept(certain), kept(possible));
    certain + (possible - certain) * (first * first + first * last + last * last) / 3.0
}

/// Returns the correlation of the uniform images of two normal values of correlation `normal`, in [-1, 1].
///
/// What two thresholds of the copula join have in common.
#[must_use]
pub fn copula_correlation(normal: f64) -> f64 {
    6.0 / PI * libm::asin(0.5 * normal)
}

/// Returns the probability that the uniform images of two normal values of correlation `normal` are both at most
/// `alpha`, in [0, 1].
///
/// `normal` in [0, 1], `alpha` in (0, 1). Owen's T by eight points of Gauss and Legendre; within 1e-9.
#[must_use]
pub fn copula_joint_visibility(normal: f64, alpha: f64) -> f64 {
    const POINTS: [(f64, f64); 4] = [
        (0.183_434_642_495_649_8, 0.362_683_783_378_362),
        (0.525_532_409_916_329, 0.313_706_645_877_887_3),
        (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
        (0.960_289_856_497_536_2, 0.101_228_536_290_376_3),
    ];
    let q = normal_quantile(alpha);
    let end = ((1.0 - normal) / (1.0 + normal)).sqrt();
    let integrand = |part: f64| {
        let square = 1.0 + part * part * end * end;
        libm::exp(-0.5 * q * q * square) / square
    };
    let sum: f64 = POINTS
        .iter()
        .map(|&(x, weight)| weight * (integrand(0.5 - 0.5 * x) + integrand(0.5 + 0.5 * x)))
        .sum();
    alpha - end * sum / (2.0 * PI)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threshold::cdf::cdf;
    use crate::threshold::normal::normal_cdf;

    const WEIGHTS: [f64; 9] = [0.0, 0.1, 0.25, 1.0 / 3.0, 0.4, 0.5, 0.6, 0.75, 0.9];

    /// Midpoints of `n` equal parts of [0, 1].
    fn midpoints(n: u32) -> impl Iterator<Item = f64> {
        (0..n).map(move |i| (f64::from(i) + 0.5) / f64::from(n))
    }

    /// The mean of `f` over independent uniform hashes.
    fn mean(n: u32, f: impl Fn(f64) -> f64) -> f64 {
        midpoints(n).map(f).sum::<f64>() / f64::from(n)
    }

    #[test]
    fn the_correlation_is_that_of_the_definition() {
        for weight in WEIGHTS {
            let given = |coarse: f64| mean(600, |fine| cdf((1.0 - weight) * coarse + weight * fine, weight));
            let variance = mean(600, |coarse| (given(coarse) - 0.5).powi(2));
            let found = interpolated_correlation(weight);
            assert!((found - 12.0 * variance).abs() < 1e-5, "{weight}: {found}");
        }
        assert!((interpolated_correlation(0.5) - 103.0 / 210.0).abs() < 1e-14);
        assert!(interpolated_correlation(1.0) == 0.0 && interpolated_correlation(0.0) == 1.0);
        // The pieces meet.
        for edge in [1.0 / 3.0, 0.5] {
            let jump = interpolated_correlation(edge - 1e-9) - interpolated_correlation(edge + 1e-9);
            assert!(jump.abs() < 1e-7, "{jump}");
        }
    }

    #[test]
    fn joint_visibility_is_that_of_the_definition() {
        for weight in WEIGHTS {
            for alpha in [0.1, 0.3, 0.5, 0.9] {
                let x = quantile(alpha, weight);
                let kept = |coarse: f64| {
                    let fine = (x - (1.0 - weight) * coarse) / weight;
                    if weight == 0.0 { f64::from(coarse <= alpha) } else { fine.clamp(0.0, 1.0) }
                };
                let expected = mean(20_000, |coarse| kept(coarse).powi(2));
                let found = interpolated_joint_visibility(weight, alpha);
                assert!((found - expected).abs() < 1e-4, "{weight} {alpha}: {found} {expected}");
            }
        }
        assert!((interpolated_joint_visibility(0.5, 0.5) - 1.0 / 3.0).abs() < 1e-14);
        assert!((interpolated_joint_visibility(1e-12, 0.3) - 0.3).abs() < 1e-11);
    }

    #[test]
    fn normal_values_share_what_their_correlation_says() {
        let r = 0.6_f64;
        let given = |u: f64, alpha: f64| {
            normal_cdf((normal_quantile(alpha) - r * normal_quantile(u)) / (1.0 - r * r).sqrt())
        };
        // P(both at most alpha) with one of the two as the value that is integrated over.
        for alpha in [0.1, 0.5, 0.9] {
            let expected = mean(100_000, |u| if u <= alpha { given(u, alpha) } else { 0.0 });
            let found = copula_joint_visibility(r, alpha);
            assert!((found - expected).abs() < 1e-5, "{alpha}: {found} {expected}");
        }
        // A quarter and the angle at the median.
        let expected = 0.25 + libm::asin(r) / (2.0 * PI);
        assert!((copula_joint_visibility(r, 0.5) - expected).abs() < 1e-12);
        assert!((copula_correlation(1.0) - 1.0).abs() < 1e-15 && copula_correlation(0.0) == 0.0);
        assert!((copula_joint_visibility(1.0, 0.3) - 0.3).abs() < 1e-9);
        // The second value given the first is normal too: its image has a mean in closed form.
        let spread = (2.0 - r * r).sqrt();
        let cross = mean(100_000, |u| (u - 0.5) * (normal_cdf(r * normal_quantile(u) / spread) - 0.5));
        assert!((12.0 * cross - copula_correlation(r)).abs() < 1e-6);
    }
}
