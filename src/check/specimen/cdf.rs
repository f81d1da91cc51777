//! Eq. 2 left out, or copied with a slip.

use super::defect::Specimen;
use super::port::{Port, SOUND};
use crate::check::Subject;
use crate::threshold::cdf::{density, minor_weight, quantile};

/// Listing 1 with another function for Eq. 2; as there, the last step clamps.
fn with(cdf: fn(f64, f64) -> f64) -> Subject<'static> {
    Port { cdf, ..SOUND }.subject()
}

/// The three cases of Eq. 2 in their order.
fn cases(x: f64, a: f64) -> [f64; 3] {
    let squared = 2.0 * (a * (1.0 - a)).max(1.0e-12);
    [x * x / squared, (x - 0.5 * a) / (1.0 - a), 1.0 - (1.0 - x) * (1.0 - x) / squared]
}

/// Picks the case where `at` lies.
fn picked(cases: [f64; 3], at: f64, a: f64) -> f64 {
    if at < a {
        cases[0]
    } else if at < 1.0 - a {
        cases[1]
    } else {
        cases[2]
    }
}

pub(super) const FAMILY: &[Specimen] = &[
    Specimen {
        name: "no-cdf",
        defect: "Eq. 2 is left out: the interpolated value is not uniform, and its variance breathes with distance",
        mend: "apply the CDF of Eq. 2 to the interpolated value",
        claim: "uniform.by_lerp_factor",
        subject: || with(|x, _| x),
    },
    Specimen {
        name: "case-by-lerp-factor",
        defect: "the first case of Eq. 2 is chosen by the lerp factor and not by the interpolated value: it never is",
        mend: "compare the interpolated value with a and 1 - a",
        claim: "uniform.marginal",
        subject: || {
            with(|x, t| {
                let a = minor_weight(t);
                let [low, middle, high] = cases(x, a);
                let first = if t < a { low } else { middle };
                picked([first, middle, high], x, a)
            })
        },
    },
    Specimen {
        name: "divisor-without-two",
        defect: "the outer cases of Eq. 2 divide by a (1 - a) and not by 2 a (1 - a)",
        mend: "divide by 2 a (1 - a)",
        claim: "exact.cdf",
        subject: || {
            with(|x, t| {
                let a = minor_weight(t);
                let [low, middle, high] = cases(x, a);
                picked([2.0 * low, middle, 2.0 * high - 1.0], x, a)
            })
        },
    },
    Specimen {
        name: "a-without-min",
        defect: "a is the lerp factor itself and not the smaller of it and its complement: wrong above 1/2",
        mend: "let a = min(lerp factor, 1 - lerp factor)",
        claim: "uniform.by_lerp_factor",
        subject: || with(|x, t| picked(cases(x, t), x, t)),
    },
    Specimen {
        name: "first-cases-swapped",
        defect: "the first two cases of Eq. 2 are exchanged",
        mend: "take x^2 / (2 a (1 - a)) below a, and (x - a/2) / (1 - a) from there to 1 - a",
        claim: "uniform.marginal",
        subject: || {
            with(|x, t| {
                let a = minor_weight(t);
                let [low, middle, high] = cases(x, a);
                picked([middle, low, high], x, a)
            })
        },
    },
    Specimen {
        name: "last-case-missing",
        defect: "the last case of Eq. 2 is left out, and the middle one goes on to 1",
        mend: "take 1 - (1 - x)^2 / (2 a (1 - a)) above 1 - a",
        claim: "uniform.by_lerp_factor",
        subject: || {
            with(|x, t| {
                let a = minor_weight(t);
                let [low, middle, _] = cases(x, a);
                picked([low, middle, middle], x, a)
            })
        },
    },
    Specimen {
        name: "middle-case-unshifted",
        defect: "the middle case of Eq. 2 is x / (1 - a), without the a/2 that is taken from x",
        mend: "take (x - a/2) / (1 - a) in the middle",
        claim: "uniform.marginal",
        subject: || {
            with(|x, t| {
                let a = minor_weight(t);
                let [low, _, high] = cases(x, a);
                picked([low, x / (1.0 - a), high], x, a)
            })
        },
    },
    Specimen {
        name: "last-case-unmirrored",
        defect: "the last case of Eq. 2 squares x where it should square 1 - x",
        mend: "take 1 - (1 - x)^2 / (2 a (1 - a)) above 1 - a",
        claim: "uniform.marginal",
        subject: || {
            with(|x, t| {
                let a = minor_weight(t);
                let [low, middle, _] = cases(x, a);
                picked([low, middle, 1.0 - low], x, a)
            })
        },
    },
    Specimen {
        name: "cdf-of-equal-weights",
        defect: "the CDF is the one of two equal weights, whatever the lerp factor",
        mend: "let a = min(lerp factor, 1 - lerp factor)",
        claim: "uniform.by_lerp_factor",
        subject: || with(|x, _| picked(cases(x, 0.5), x, 0.5)),
    },
    Specimen {
        name: "inverse-for-cdf",
        defect: "the inverse of the CDF is applied, which bends the law twice as far away from uniform",
        mend: "apply the CDF itself",
        claim: "uniform.by_lerp_factor",
        subject: || with(quantile),
    },
    Specimen {
        name: "density-for-cdf",
        defect: "the density is applied and not its integral",
        mend: "apply the CDF of Eq. 2",
        claim: "uniform.marginal",
        subject: || with(density),
    },
    Specimen {
        name: "smoothstep-for-cdf",
        defect: "a smoothstep stands in for Eq. 2",
        mend: "apply the CDF of Eq. 2",
        claim: "uniform.marginal",
        subject: || with(|x, _| x * x * (3.0 - 2.0 * x)),
    },
    Specimen {
        name: "cdf-twice",
        defect: "the CDF is applied to what is uniform already",
        mend: "apply the CDF once",
        claim: "uniform.by_lerp_factor",
        subject: || with(|x, t| (SOUND.cdf)((SOUND.cdf)(x, t), t)),
    },
];
