//! The size of a pixel on the surface, measured wrongly. The marginal law does not notice: only the size of the noise does.

use super::defect::Specimen;
use super::port::{Port, SOUND, of_footprint, robust};
use crate::check::Subject;
use crate::check::subject::Precision;
use crate::threshold::footprint::Footprint;
use crate::threshold::robust::Robust;
use crate::threshold::two_scale::Variant;
use glam::DVec3;

/// Listing 1 with another length for `max(length(dFdx), length(dFdy))`.
fn of_length(length: fn(DVec3, DVec3) -> f64) -> Subject<'static> {
    of_footprint(Precision::F64, move |found| {
        // A length that overflows is another defect.
        let dpdx = DVec3::X * length(found.dpdx, found.dpdy).min(1.0e100);
        robust(Variant::Isotropic)
            .threshold(&Footprint { dpdx, dpdy: DVec3::ZERO, ..*found })
            .unwrap_or(f64::NAN)
    })
}

/// A robust threshold of one hash scale that claims to have another.
fn of_scale(variant: Variant, hash_scale: f64, claimed: f64) -> Subject<'static> {
    let mut subject = Subject::robust("specimen", Precision::F64, Robust { hash_scale, ..robust(variant) });
    subject.hash_scale = claimed;
    subject
}

pub(super) const FAMILY: &[Specimen] = &[
    Specimen {
        name: "dfdx-twice",
        defect: "the derivative along screen x stands in for the one along y",
        mend: "take dFdy for the second derivative",
        claim: "spectrum.anisotropy",
        subject: || {
            Port { read: |at| Footprint { dpdy: at.footprint.dpdx, ..at.footprint }, ..SOUND }.subject()
        },
    },
    Specimen {
        name: "fwidth",
        defect: "the length of fwidth, |dFdx| + |dFdy|, stands in for the longer of the two derivatives",
        mend: "take max(length(dFdx), length(dFdy))",
        claim: "flips.rotation",
        subject: || of_length(|x, y| (x.abs() + y.abs()).length()),
    },
    Specimen {
        name: "length-of-sum",
        defect: "the length of the sum of the derivatives stands in for the longer of the two",
        mend: "take max(length(dFdx), length(dFdy))",
        claim: "symmetry.derivatives",
        subject: || of_length(|x, y| (x + y).length()),
    },
    Specimen {
        name: "sum-of-lengths",
        defect: "the lengths of the derivatives are added",
        mend: "take max(length(dFdx), length(dFdy))",
        claim: "stability.translate",
        subject: || of_length(|x, y| x.length() + y.length()),
    },
    Specimen {
        name: "min-for-max",
        defect: "the shorter of the two derivatives counts, so cells are smaller than a pixel at grazing angles",
        mend: "take max(length(dFdx), length(dFdy))",
        claim: "flips.tilt",
        subject: || of_length(|x, y| x.length().min(y.length())),
    },
    Specimen {
        name: "area-of-a-pixel",
        defect: "the root of the pixel's area on the surface stands in for its longer side",
        mend: "take max(length(dFdx), length(dFdy))",
        claim: "noise_scale.tilted",
        subject: || of_length(|x, y| x.cross(y).length().sqrt()),
    },
    Specimen {
        name: "largest-component",
        defect: "the largest component of a derivative stands in for its length",
        mend: "take length() of all three components",
        claim: "stability.translate",
        subject: || of_length(|x, y| x.abs().max_element().max(y.abs().max_element())),
    },
    Specimen {
        name: "derivative-without-z",
        defect: "only x and y of the derivatives are measured",
        mend: "take length() of all three components",
        claim: "stability.translate_aligned",
        subject: || of_length(|x, y| x.truncate().length().max(y.truncate().length())),
    },
    Specimen {
        name: "squared-length",
        defect: "dot(d, d) is taken for the length of d, without the root",
        mend: "take the square root, or half of the logarithm",
        claim: "stability.translate",
        subject: || of_length(|x, y| x.length_squared().max(y.length_squared())),
    },
    Specimen {
        name: "inverse-scale",
        defect: "the position is multiplied by the size of a pixel where it should be divided by it",
        mend: "take 1 / (hash scale * derivative) for the scale",
        claim: "uniform.coverage",
        subject: || of_length(|x, y| 1.0 / x.length().max(y.length())),
    },
    Specimen {
        name: "half-the-noise",
        defect: "cells are half as large as the hash scale says, as if it were a radius",
        mend: "let one cell be hash scale pixels wide",
        claim: "noise_scale.frontal",
        subject: || of_scale(Variant::Isotropic, 0.5, 1.0),
    },
    Specimen {
        name: "hash-scale-ignored",
        defect: "the noise is one pixel wide whatever the hash scale",
        mend: "multiply the derivative by the hash scale",
        claim: "stability.translate",
        subject: || of_scale(Variant::Isotropic, 1.0, 0.5),
    },
    Specimen {
        name: "hash-scale-divides",
        defect: "the hash scale divides the derivative, so a smaller one gives coarser noise",
        mend: "multiply the derivative by the hash scale",
        claim: "stability.translate",
        subject: || of_scale(Variant::Isotropic, 2.0, 0.5),
    },
    Specimen {
        name: "missing-sqrt-half",
        defect: "the anisotropic scales lack the factor 0.707, so the side of a cell is a pixel and not its diagonal",
        mend: "divide 0.707 by the derivative of each axis",
        claim: "stability.translate",
        subject: || of_scale(Variant::Anisotropic, 0.707, 1.0),
    },
    Specimen {
        name: "axes-exchanged",
        defect: "the scales of the x and y axes are exchanged",
        mend: "scale each coordinate by the derivative along its own axis",
        claim: "stability.translate",
        subject: || {
            let exchanged = |found: &Footprint<f64>| {
                let [dpdx, dpdy] = [found.dpdx, found.dpdy].map(|d| DVec3::new(d.y, d.x, d.z));
                robust(Variant::Anisotropic).threshold(&Footprint { dpdx, dpdy, ..*found }).ok()
            };
            let mut subject = Subject::new("specimen", Precision::F64, Variant::Anisotropic, exchanged);
            (subject.nested_phase, subject.join) = (true, robust(Variant::Anisotropic).join);
            subject
        },
    },
];
