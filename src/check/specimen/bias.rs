//! Right in the mean, and wrong on each surface: biases that cancel where surfaces are pooled.

use super::defect::Specimen;
use super::port::SOUND;
use crate::check::Subject;
use crate::check::subject::Precision;
use crate::scene::Fragment;
use crate::threshold::footprint::Footprint;
use crate::threshold::two_scale::Variant;
use glam::DVec3;

/// The sound threshold raised to a power that depends on the place.
fn bent(exponent: fn(&Footprint<f64>) -> f64) -> Subject<'static> {
    let sound = SOUND.subject();
    let threshold =
        move |at: &Fragment| Some(libm::pow(sound.threshold(*at)?, exponent(&at.footprint)).max(1.0e-6));
    let mut subject = Subject::of_fragments("specimen", Precision::F64, Variant::Isotropic, threshold);
    subject.nested_phase = true;
    subject
}

/// An exponent on one side, its inverse on the other.
fn either(first: bool) -> f64 {
    if first { 1.15 } else { 1.0 / 1.15 }
}

pub(super) const FAMILY: &[Specimen] = &[
    Specimen {
        name: "grazing-surfaces-denser",
        defect: "a correction for grazing surfaces keeps too much of them, and too little of the others",
        mend: "compare alpha with the threshold as it is",
        claim: "coverage.mean",
        subject: || bent(|found| either(found.dpdy.length() > 2.0 * found.dpdx.length())),
    },
    Specimen {
        name: "walls-denser-than-floors",
        defect: "a correction by the orientation keeps too much of surfaces of constant z, and too little of the others",
        mend: "compare alpha with the threshold as it is",
        claim: "coverage.mean_aligned",
        subject: || bent(|found| either(found.dpdx.z == 0.0 && found.dpdy.z == 0.0)),
    },
    Specimen {
        name: "drifting-gamma",
        defect: "a gamma that drifts slowly through space makes one surface too dense and another one too sparse",
        mend: "compare alpha with the threshold as it is",
        claim: "uniform.any_plane",
        subject: || bent(|found| 1.0 + 0.1 * libm::sin(found.position.dot(DVec3::new(0.13, 0.11, -0.12)))),
    },
];
