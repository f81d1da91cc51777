//! The wrong octaves, or the wrong weight between them.

use super::defect::Specimen;
use super::port::{Port, SOUND, cell, cut, ideal_hash, of_footprint};
use crate::check::Subject;
use crate::check::subject::Precision;
use crate::threshold::cdf;
use crate::threshold::footprint::Footprint;
use crate::threshold::real::{Real, log2_f32};
use glam::DVec3;

/// Listing 1 with other octaves.
const fn between(octaves: fn(i32, f64) -> ([i32; 2], f64)) -> Port {
    Port { octaves, ..SOUND }
}

/// The longer of the two derivatives, as in Listing 1.
fn longest(found: &Footprint<f64>) -> f64 {
    found.dpdx.length().max(found.dpdy.length()).clamp(1.0e-30, 1.0e30)
}

/// A threshold that takes its scale from [`longest`] and nothing else.
fn of_scale(precision: Precision, threshold: fn(DVec3, f64) -> f64) -> Subject<'static> {
    of_footprint(precision, move |found| threshold(found.position, 1.0 / longest(found)))
}

pub(super) const FAMILY: &[Specimen] = &[
    Specimen {
        name: "one-octave-for-both",
        defect: "both hashes are taken at the same octave, so they are one hash",
        mend: "hash the finer cell at the next octave",
        claim: "uniform.by_lerp_factor",
        subject: || between(|octave, t| ([octave; 2], t)).subject(),
    },
    Specimen {
        name: "octave-skipped",
        defect: "the second cell is two octaves finer than the first",
        mend: "hash the finer cell at the next octave",
        claim: "continuity.octave_boundary",
        subject: || between(|octave, t| ([octave, octave + 2], t)).subject(),
    },
    Specimen {
        name: "coarser-for-finer",
        defect: "the second cell is one octave coarser than the first, and not one finer",
        mend: "take the ceiling of the logarithm for the second octave",
        claim: "spectrum.autocorrelation",
        subject: || between(|octave, t| ([octave, octave - 1], t)).subject(),
    },
    Specimen {
        name: "weights-swapped",
        defect: "the finer hash has the weight of the coarser one",
        mend: "let the weight of the finer octave be the fraction of the logarithm",
        claim: "continuity.zoom",
        subject: || between(|octave, t| ([octave + 1, octave], t)).subject(),
    },
    Specimen {
        name: "weight-always-half",
        defect: "the two octaves are averaged whatever the fraction of the logarithm",
        mend: "let the weight of the finer octave be the fraction of the logarithm",
        claim: "continuity.octave_boundary",
        subject: || between(|octave, _| ([octave, octave + 1], 0.5)).subject(),
    },
    Specimen {
        name: "coarse-octave-alone",
        defect: "the octave is rounded down and there is no second one, so thresholds are redrawn at every octave",
        mend: "interpolate between two octaves",
        claim: "continuity.octave_boundary",
        subject: || between(|octave, _| ([octave; 2], 0.0)).subject(),
    },
    Specimen {
        name: "nearest-octave",
        defect: "the nearest octave is taken alone, so thresholds are redrawn halfway between octaves",
        mend: "interpolate between two octaves",
        claim: "continuity.zoom",
        subject: || between(|octave, t| ([octave + i32::from(t >= 0.5); 2], 0.0)).subject(),
    },
    Specimen {
        name: "no-octaves",
        defect: "the scale is used as it is, so cells slide over the surface as the camera moves",
        mend: "round the scale to powers of two, and interpolate between two of them",
        claim: "continuity.tilt",
        subject: || {
            of_scale(Precision::F64, |position, scale| ideal_hash((position * scale).floor().into(), 0))
        },
    },
    Specimen {
        name: "natural-logarithm",
        defect: "the octave comes from a natural logarithm, so cells do not follow the size of a pixel by powers of two",
        mend: "use log2 and exp2",
        claim: "stability.translate",
        subject: || {
            of_scale(Precision::F64, |position, scale| {
                let log = libm::log(scale);
                let hash =
                    |octave: f64| ideal_hash((position * libm::exp(octave)).floor().into(), octave as i32);
                let t = log - log.floor();
                cdf::cdf((1.0 - t) * hash(log.floor()) + t * hash(log.floor() + 1.0), t)
            })
        },
    },
    Specimen {
        name: "octave-from-exponent",
        defect: "the octave comes from the exponent and the weight from a rounded logarithm, which disagree at powers of two",
        mend: "take floor and fraction of one logarithm",
        claim: "continuity.octave_boundary",
        subject: || {
            of_scale(Precision::F32, |position, scale| {
                let scale = scale as f32;
                let octave = (scale.to_bits() >> 23) as i32 - 127;
                let t = f64::from(Real::fract(log2_f32(scale)));
                let [coarse, fine] =
                    [octave, octave + 1].map(|octave| ideal_hash(cell(position, octave), octave));
                cdf::cdf((1.0 - t) * coarse + t * fine, t)
            })
        },
    },
    Specimen {
        name: "linear-weight",
        defect: "the weight is where the scale lies between two powers of two, on a linear scale, and the CDF has the logarithm's",
        mend: "let one weight, the fraction of the logarithm, join the hashes and enter the CDF",
        claim: "uniform.by_lerp_factor",
        subject: || {
            Port {
                join: |[coarse, fine], t| {
                    let linear = libm::exp2(t) - 1.0;
                    (1.0 - linear) * coarse + linear * fine
                },
                ..SOUND
            }
            .subject()
        },
    },
    Specimen {
        name: "same-phase-for-all-octaves",
        defect: "cells are shifted by the same part of a cell in every octave, so fine cells do not divide coarse ones",
        mend: "shift by 1/3 in even octaves and 2/3 in odd ones, or not at all",
        claim: "stability.translate",
        subject: || {
            Port {
                cell: |position, octave| cut(position + 0.38 * libm::ldexp(1.0, -octave), octave, f64::floor),
                ..SOUND
            }
            .subject()
        },
    },
];
