//! How far a threshold may move between two views of a point, by the join that a subject claims to have.

use crate::check::Subject;
use crate::check::subject::{Nominal, Precision};
use crate::check::tolerance::{COPULA_SLOPE, COPULA_SLOPE_OF_AN_AXIS, INTERPOLATION_SLOPE, POP_ROUNDING};
use crate::threshold::robust::Join;
use crate::threshold::two_scale::Variant;

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
        _ => INTERPOLATION_SLOPE * distance.into_iter().fold(0.0, f64::max),
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
}
