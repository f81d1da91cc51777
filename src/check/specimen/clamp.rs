//! The last step: a range that is cut, bent or left open.

use super::defect::Specimen;
use super::port::{Port, SOUND};
use crate::check::Subject;

/// Listing 1 with another last step.
fn ending(clamp: fn(f64) -> f64) -> Subject<'static> {
    Port { clamp, ..SOUND }.subject()
}

pub(super) const FAMILY: &[Specimen] = &[
    Specimen {
        name: "clamped-at-zero",
        defect: "nothing keeps a threshold above 0, and where it is 0 alpha 0 is kept",
        mend: "clamp to a smallest threshold above 0, last of all",
        claim: "range",
        subject: || ending(|threshold| (255.0 * threshold).floor() / 255.0),
    },
    Specimen {
        name: "no-clamp",
        defect: "a threshold is moved down by half a step of 8 bits and not clamped: some are below 0",
        mend: "clamp to a smallest threshold above 0, last of all",
        claim: "range",
        subject: || ending(|threshold| threshold - 0.5 / 255.0),
    },
    Specimen {
        name: "clamped-by-255ths",
        defect: "thresholds have a floor, as 1/255, so faint texels are never kept",
        mend: "clamp to 1e-6 or below",
        claim: "atoms.ends",
        subject: || ending(|threshold| threshold.max(1.0 / 255.0)),
    },
    Specimen {
        name: "clamped-below-opaque",
        defect: "thresholds have a ceiling below 1, as 0.98, so that nearly opaque texels are surely kept",
        mend: "clamp to 1: alpha 1 is kept at a threshold of 1",
        claim: "atoms.ends",
        subject: || ending(|threshold| threshold.clamp(1.0e-6, 0.98)),
    },
    Specimen {
        name: "safe-middle",
        defect: "thresholds are squeezed into a part of (0, 1], as [0.1, 0.9], so faint texels vanish and dense ones become solid",
        mend: "leave the threshold in (0, 1]",
        claim: "uniform.marginal",
        subject: || ending(|threshold| 0.1 + 0.8 * threshold),
    },
    Specimen {
        name: "around-a-cutoff",
        defect: "thresholds stay within a quarter of a cutoff of 1/2, as noise that is added to an alpha test does",
        mend: "let the threshold itself be the hash, in (0, 1]",
        claim: "uniform.marginal",
        subject: || ending(|threshold| 0.25 + 0.5 * threshold),
    },
    Specimen {
        name: "gamma-curve",
        defect: "the threshold has gone through a gamma curve",
        mend: "compare alpha with the threshold as it is; neither is a colour",
        claim: "uniform.coverage",
        subject: || ending(|threshold| libm::pow(threshold, 1.1)),
    },
    Specimen {
        name: "srgb-curve",
        defect: "the threshold is read through an sRGB texture or target",
        mend: "compare alpha with the threshold as it is; neither is a colour",
        claim: "uniform.marginal",
        subject: || ending(|threshold| libm::pow((threshold + 0.055) / 1.055, 2.4)),
    },
];
