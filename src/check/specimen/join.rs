//! Two hashes made one in another way than the CDF expects.

use super::defect::Specimen;
use super::port::{Port, SOUND, cell, ideal_hash, of_footprint, robust};
use crate::check::Subject;
use crate::check::subject::Precision;
use crate::threshold::cdf::CdfForm;
use crate::threshold::footprint::Footprint;
use crate::threshold::hash::HashKind;
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::normal::{normal_cdf, normal_quantile};
use crate::threshold::robust::{Join, Repairs, Robust, scales};
use crate::threshold::two_scale::Variant;

/// Listing 1 with another way of joining, which needs no CDF where `needs_none`.
const fn joined(join: fn([f64; 2], f64) -> f64, needs_none: bool) -> Port {
    let cdf = if needs_none { (|x, _| x) as fn(f64, f64) -> f64 } else { SOUND.cdf };
    Port { join, cdf, ..SOUND }
}

fn fraction(value: f64) -> f64 {
    value - value.floor()
}

/// A dithered threshold that draws its choice from the coarse cell and the view in its own way.
fn dithered(coin: fn([f64; 3], &Footprint<f64>) -> f64) -> Subject<'static> {
    let mut subject = of_footprint(Precision::F64, move |found| {
        let scales = scales::robust_scales::<f64>(Variant::Isotropic, found, 1.0, Repairs::ALL);
        let (octave, fraction) = (scales.octave[0], scales.fraction[0]);
        let coarse = cell(found.position, octave);
        if fraction > coin(coarse, found) {
            ideal_hash(cell(found.position, octave + 1), octave + 1)
        } else {
            ideal_hash(coarse, octave)
        }
    });
    subject.join = Join::Dithered;
    subject
}

pub(super) const FAMILY: &[Specimen] = &[
    Specimen {
        name: "sum-that-wraps",
        defect: "the two hashes are added and the fraction taken: uniform, and whatever changes one of them redraws it",
        mend: "interpolate between the hashes, and apply the CDF",
        claim: "flips.translation",
        subject: || joined(|[coarse, fine], _| fraction(coarse + fine), true).subject(),
    },
    Specimen {
        name: "larger-of-two",
        defect: "the larger of the two hashes is taken, so thresholds are too high",
        mend: "interpolate between the hashes, and apply the CDF",
        claim: "uniform.marginal",
        subject: || joined(|[coarse, fine], _| coarse.max(fine), true).subject(),
    },
    Specimen {
        name: "product-of-two",
        defect: "the two hashes are multiplied, so thresholds are too low",
        mend: "interpolate between the hashes, and apply the CDF",
        claim: "uniform.marginal",
        subject: || joined(|[coarse, fine], _| coarse * fine, true).subject(),
    },
    Specimen {
        name: "second-hash-from-the-first",
        defect: "the second hash is 1 - h of the first, as if to save a hash: the two are no longer independent",
        mend: "hash the finer cell",
        claim: "uniform.by_lerp_factor",
        subject: || joined(|[coarse, _], t| (1.0 - t) * coarse + t * (1.0 - coarse), false).subject(),
    },
    Specimen {
        name: "weights-that-add-up-to-more",
        defect: "the first hash is not weighted by 1 - t, so the mixture exceeds 1",
        mend: "mix with weights 1 - t and t",
        claim: "uniform.marginal",
        subject: || joined(|[coarse, fine], t| (coarse + t * fine).min(1.0), false).subject(),
    },
    Specimen {
        name: "geometric-mean",
        defect: "the hashes are mixed by their logarithms, as colours sometimes are",
        mend: "mix the hashes linearly",
        claim: "uniform.by_lerp_factor",
        subject: || {
            joined(|[coarse, fine], t| libm::pow(coarse, 1.0 - t) * libm::pow(fine, t), false).subject()
        },
    },
    Specimen {
        name: "smoothstep-weight",
        defect: "the weight is smoothed before it mixes the hashes, and the CDF has the plain one",
        mend: "let one weight join the hashes and enter the CDF",
        claim: "uniform.by_lerp_factor",
        subject: || {
            joined(
                |[coarse, fine], t| {
                    let smooth = t * t * (3.0 - 2.0 * t);
                    (1.0 - smooth) * coarse + smooth * fine
                },
                false,
            )
            .subject()
        },
    },
    Specimen {
        name: "salt-by-role",
        defect: "the hash is told which of the two cells it sees and not which octave: thresholds are redrawn at every octave",
        mend: "hash the octave of the cell, not its role",
        claim: "continuity.octave_boundary",
        subject: || {
            of_footprint(Precision::F64, |found| {
                let scales = scales::robust_scales::<f64>(Variant::Isotropic, found, 1.0, Repairs::ALL);
                let (octave, t) = (scales.octave[0], scales.fraction[0]);
                let coarse = ideal_hash(cell(found.position, octave), 0);
                let fine = ideal_hash(cell(found.position, octave + 1), 1);
                (SOUND.cdf)((SOUND.join)([coarse, fine], t), t)
            })
        },
    },
    Specimen {
        name: "dither-drawn-anew",
        defect: "the choice between octaves is drawn anew with every view, so thresholds flicker as the camera moves",
        mend: "draw the choice from the coarse cell",
        claim: "flips.zoom",
        subject: || {
            dithered(|coarse, found| {
                let view = found.dpdy.x.to_bits() ^ found.dpdy.y.to_bits().rotate_left(17);
                ideal_hash(coarse, (view ^ (view >> 32)) as i32)
            })
        },
    },
    Specimen {
        name: "dither-in-blocks",
        defect: "the choice between octaves is drawn once for a block of eight cells along each axis, all of which flip together",
        mend: "draw the choice from the coarse cell itself",
        claim: "flips.cluster",
        subject: || dithered(|coarse, _| ideal_hash(coarse.map(|index| (index / 8.0).floor()), 1000)),
    },
    Specimen {
        name: "one-weight-for-three-scales",
        defect: "one weight joins three scales: when one axis passes an octave, both cells of Listing 2 are exchanged",
        mend: "mix the eight corners with a weight an axis, by the copula",
        claim: "continuity.rotation",
        subject: || {
            let robust = Robust { join: Join::Interpolate, ..robust(Variant::Anisotropic) };
            Subject::robust("specimen", Precision::F64, robust)
        },
    },
    Specimen {
        name: "copula-without-its-root",
        defect: "the mixture of normal quantiles is not divided by the root of the sum of squared weights",
        mend: "divide by sqrt of the sum of squared weights before the normal CDF",
        claim: "uniform.by_lerp_factor",
        subject: || {
            let mut subject = of_footprint(Precision::F64, |found| {
                let scales = scales::robust_scales::<f64>(Variant::Isotropic, found, 1.0, Repairs::ALL);
                let (octave, t) = (scales.octave[0], scales.fraction[0]);
                let normal = |octave: i32| normal_quantile(ideal_hash(cell(found.position, octave), octave));
                normal_cdf((1.0 - t) * normal(octave) + t * normal(octave + 1))
            });
            subject.join = Join::Copula;
            subject
        },
    },
    Specimen {
        name: "one-scale-of-any-size",
        defect: "there is one hash at a scale that is not rounded to an octave: no CDF is needed, and nothing is stable",
        mend: "round the scale to powers of two, and interpolate between two of them",
        claim: "uniform.without_cdf",
        subject: || {
            let single = HashedAlpha {
                variant: Variant::Single,
                hash: HashKind::Mm4,
                hash_scale: 1.0,
                form: CdfForm::Stable,
            };
            Subject::hashed("specimen", Precision::F64, single)
        },
    },
];
