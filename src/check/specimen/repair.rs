//! What the listings leave out: the robust threshold without one of its repairs.

use super::defect::Specimen;
use super::port::robust;
use crate::check::Subject;
use crate::check::subject::Precision;
use crate::threshold::footprint::Footprint;
use crate::threshold::robust::{Repair, Repairs, Robust};
use crate::threshold::two_scale::Variant;

fn without(repair: Repair, variant: Variant) -> Subject<'static> {
    let repairs = Repairs::ALL.without(repair);
    Subject::robust("specimen", Precision::F32, Robust { repairs, ..robust(variant) })
}

pub(super) const FAMILY: &[Specimen] = &[
    Specimen {
        name: "unchecked-inputs",
        defect: "NaN and infinities are computed with, and a NaN threshold keeps every fragment",
        mend: "refuse or replace coordinates and derivatives that are not finite",
        claim: "range.degenerate",
        subject: || without(Repair::ValidateInputs, Variant::Isotropic),
    },
    Specimen {
        name: "no-derivative-floor",
        defect: "a derivative of zero is divided by",
        mend: "let no cell be smaller than 2^-21 of the largest coordinate",
        claim: "range.far_from_origin",
        subject: || without(Repair::DerivativeFloor, Variant::Isotropic),
    },
    Specimen {
        name: "no-floor-along-an-axis",
        defect: "along an axis on which the surface is constant, its derivative of zero is divided by",
        mend: "let no side of a cell be smaller than 2^-5 of the longest",
        claim: "planes.axis_aligned",
        subject: || without(Repair::DerivativeFloor, Variant::Anisotropic),
    },
    Specimen {
        name: "zero-derivatives-skipped",
        defect: "axes without a derivative are left out, but not those whose derivative is rounding noise",
        mend: "let no side of a cell be smaller than 2^-5 of the longest",
        claim: "planes.axis_aligned",
        subject: || {
            let robust = Robust {
                repairs: Repairs::ALL.without(Repair::DerivativeFloor),
                ..robust(Variant::Anisotropic)
            };
            let patched = move |found: &Footprint<f64>| {
                let mut patched = *found;
                for axis in 0..3 {
                    if found.dpdx[axis] == 0.0 && found.dpdy[axis] == 0.0 {
                        patched.dpdx[axis] = found.dpdx.abs().max_element();
                    }
                }
                robust.threshold(&patched).ok()
            };
            let mut subject = Subject::new("specimen", Precision::F64, Variant::Anisotropic, patched);
            (subject.nested_phase, subject.join) = (true, robust.join);
            subject
        },
    },
    Specimen {
        name: "cells-at-whole-numbers",
        defect: "cells begin at whole numbers, on which planes of real models lie: rounding decides in which cell a pixel is",
        mend: "shift cells by 1/3 in even octaves and 2/3 in odd ones",
        claim: "planes.dyadic",
        subject: || without(Repair::NestedPhase, Variant::Isotropic),
    },
    Specimen {
        name: "no-octave-word",
        defect: "cells of equal index in different octaves hash alike, in 32 bits and along three scales",
        mend: "hash the octave as a fourth word",
        claim: "cells.origin",
        subject: || without(Repair::OctaveWord, Variant::Anisotropic),
    },
];
