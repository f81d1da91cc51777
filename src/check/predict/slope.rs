//! How far a threshold may move between two views of a point, by the join that a subject claims to have.

use crate::check::subject::Nominal;
use crate::check::{Precision, Subject};
use crate::threshold::robust::Join;
use crate::threshold::two_scale::Variant;

/// Most that interpolation moves per octave of the scale. Eq. 2: |d tau / d l| <= 1 / (2 (1 - a)^2) <= 2; the weight of
/// Listing 2 moves by at most |d f| / sqrt 3, since the distances to two opposite corners add up to sqrt 3 or more.
const INTERPOLATION_SLOPE: f64 = 2.0;

/// Most that the copula of two cells moves per octave: phi(0) Q / ((1 - l)^2 + l^2)^(3/2), with quantiles up to
/// Q = 5.42 for hashes that keep 2^-25 away from 0 and 1; 6.12 at l = 1/2.
const COPULA_SLOPE: f64 = 6.2;

/// Most that the copula of eight cells moves per octave of one axis: each of the other two, halfway, adds a factor of
/// sqrt 2 to [`COPULA_SLOPE`]. The axes add up.
const COPULA_SLOPE_OF_AN_AXIS: f64 = 2.0 * COPULA_SLOPE;

/// What rounding may add to the change between two views, in `f32` and `f64`: 16 roundings of a number below 1, and
/// for the `f64` copula those of its quantiles.
const POP_ROUNDING: [f64; 2] = [1.0 / 1_048_576.0, 1.0 / 17_592_186_044_416.0];

/// The logarithm to base two of the cells per object unit along each axis.
pub(crate) fn log_scale(nominal: &Nominal) -> [f64; 3] {
    [0, 1, 2].map(|axis| libm::log2(nominal.coarse_scale[axis]) + nominal.fraction[axis])
}

/// How far two scales are apart along each axis, in octaves.
pub(crate) fn octaves_between(before: &Nominal, after: &Nominal) -> [f64; 3] {
    let (before, after) = (log_scale(before), log_scale(after));
    [0, 1, 2].map(|axis| (after[axis] - before[axis]).abs())
}

/// The most by which a continuous join changes between two scales.
pub(crate) fn largest_change(subject: &Subject<'_>, before: &Nominal, after: &Nominal) -> f64 {
    let distance = octaves_between(before, after);
    let slope = match (subject.join, subject.variant) {
        (Join::Copula, Variant::Anisotropic) => COPULA_SLOPE_OF_AN_AXIS * distance.iter().sum::<f64>(),
        (Join::Copula, _) => COPULA_SLOPE * distance[0],
        (Join::Interpolate | Join::Dithered | Join::Inherit, _) => {
            INTERPOLATION_SLOPE * distance.into_iter().fold(0.0, f64::max)
        }
    };
    slope + rounding(subject.precision)
}

fn rounding(precision: Precision) -> f64 {
    POP_ROUNDING[usize::from(precision == Precision::F64)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::specimen::ideal;
    use crate::stats::normal;
    use crate::threshold::cdf::cdf;
    use crate::threshold::normal::normal_quantile;
    use glam::DVec3;

    /// The axes of the copula add up, those of an interpolation do not, and one scale has one distance.
    #[test]
    fn each_join_may_move_as_far_as_its_slope_allows() {
        let moved = |join, variant| {
            let subject = ideal(0, variant, Precision::F64, join);
            let view = |fraction| Nominal {
                coarse_scale: [4.0; 3],
                fine_scale: [8.0; 3],
                coarse_cell: DVec3::ZERO,
                fine_cell: DVec3::ZERO,
                fraction,
                lerp_factor: 0.0,
            };
            largest_change(&subject, &view([0.25, 0.5, 0.5]), &view([0.5, 0.5, 0.375]))
                - rounding(subject.precision)
        };
        for (join, variant, slope) in [
            (Join::Copula, Variant::Isotropic, 0.25 * COPULA_SLOPE),
            (Join::Copula, Variant::Anisotropic, 0.375 * COPULA_SLOPE_OF_AN_AXIS),
            (Join::Interpolate, Variant::Isotropic, 0.25 * INTERPOLATION_SLOPE),
            (Join::Interpolate, Variant::Anisotropic, 0.25 * INTERPOLATION_SLOPE),
        ] {
            assert!((moved(join, variant) - slope).abs() < 1.0e-12, "{join} {variant}");
        }
    }

    /// The slopes are reached: of the steepest thresholds, nine tenths.
    #[test]
    fn slopes_are_not_larger_than_thresholds_are_steep() {
        let steepest = |at: &dyn Fn(f64, f64, f64) -> f64, hashes: &[f64]| {
            let mut most = 0.0_f64;
            for step in 1..400 {
                let l = f64::from(step) / 400.0;
                for &coarse in hashes {
                    for &fine in hashes {
                        let change = at(coarse, fine, l + 1.0e-6) - at(coarse, fine, l - 1.0e-6);
                        most = most.max(change.abs() / 2.0e-6);
                    }
                }
            }
            most
        };
        let even: Vec<f64> = (0..=64).map(|i| f64::from(i) / 64.0).collect();
        let interpolated = |coarse: f64, fine: f64, l: f64| cdf(coarse + (fine - coarse) * l, l);
        let found = steepest(&interpolated, &even);
        assert!((0.9..=1.0).contains(&(found / INTERPOLATION_SLOPE)), "{found}");
        let ends = [libm::exp2(-25.0), 1.0e-3, 0.5, 1.0 - 1.0e-3, 1.0 - libm::exp2(-25.0)];
        let copula = |coarse: f64, fine: f64, l: f64| {
            let sum = (1.0 - l) * normal_quantile(coarse) + l * normal_quantile(fine);
            normal::upper_p(-sum / (l * l + (1.0 - l) * (1.0 - l)).sqrt())
        };
        let found = steepest(&copula, &ends);
        assert!((0.9..=1.0).contains(&(found / COPULA_SLOPE)), "{found}");
    }
}
