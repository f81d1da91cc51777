//! Sound in scenes of everyday size and wrong elsewhere: far away, in cells of unusual size, at grazing angles.

use super::defect::Specimen;
use super::port::{Port, SOUND, cell, ideal_hash};
use crate::scene::Fragment;
use crate::threshold::footprint::Footprint;
use glam::DVec3;

/// The same surface, so much closer to the object's origin.
fn nearer(fragment: &Fragment, reach: f64) -> Footprint<f64> {
    let footprint = fragment.footprint;
    Footprint { position: footprint.position.clamp(DVec3::splat(-reach), DVec3::splat(reach)), ..footprint }
}

/// How many times the longer derivative is as long as the shorter one.
fn ratio(found: &Footprint<f64>) -> f64 {
    let lengths = [found.dpdx.length(), found.dpdy.length()];
    lengths[0].max(lengths[1]) / lengths[0].min(lengths[1]).max(1.0e-30)
}

pub(super) const FAMILY: &[Specimen] = &[
    Specimen {
        name: "coordinates-end",
        defect: "coordinates beyond 500 units count as 500, so that distant surfaces have the same few cells",
        mend: "hash the coordinates as they are",
        claim: "domain.uniform",
        subject: || Port { read: |fragment| nearer(fragment, 500.0), ..SOUND }.subject(),
    },
    Specimen {
        name: "biased-in-large-cells",
        defect: "in cells of more than 16 units thresholds are a tenth too small",
        mend: "treat every octave alike",
        claim: "domain.uniform",
        subject: || {
            let hash = |index, octave| {
                let value = ideal_hash(index, octave);
                if octave < -4 { value * value.sqrt().sqrt() } else { value }
            };
            Port { hash, ..SOUND }.subject()
        },
    },
    Specimen {
        name: "index-loses-a-bit-in-small-cells",
        defect: "from the 14th octave on the last bit of the index along x is lost, so that two cells are one",
        mend: "hash the whole index",
        claim: "domain.neighbours",
        subject: || {
            let cell = |position, octave| {
                let [x, y, z] = cell(position, octave);
                [if octave >= 14 { 2.0 * (x / 2.0).floor() } else { x }, y, z]
            };
            Port { cell, ..SOUND }.subject()
        },
    },
    Specimen {
        name: "layers-alike-in-large-cells",
        defect: "in cells of more than four units the hash leaves out z, so that surfaces one behind the other are alike",
        mend: "hash all three indices",
        claim: "domain.layers",
        subject: || {
            let hash =
                |[x, y, z]: [f64; 3], octave| ideal_hash([x, y, if octave < -2 { 0.0 } else { z }], octave);
            Port { hash, ..SOUND }.subject()
        },
    },
    Specimen {
        name: "grazing-angles-cut",
        defect: "where one derivative is more than 32 times the other, the scale is taken from 32 times the shorter one, so that cells \
                 are smaller than a pixel",
        mend: "take the longer derivative, whatever the other is",
        claim: "domain.changes",
        subject: || {
            let read = |fragment: &Fragment| {
                let found = fragment.footprint;
                let times = 32.0 / ratio(&found).max(32.0);
                Footprint { dpdx: found.dpdx * times, dpdy: found.dpdy * times, ..found }
            };
            Port { read, ..SOUND }.subject()
        },
    },
    Specimen {
        name: "weights-swapped-in-small-cells",
        defect: "from the 12th octave on the finer hash has the weight of the coarser one, so that thresholds jump at every octave",
        mend: "treat every octave alike",
        claim: "domain.continuity",
        subject: || {
            let octaves = |octave, t: f64| ([octave, octave + 1], if octave >= 12 { 1.0 - t } else { t });
            Port { octaves, ..SOUND }.subject()
        },
    },
];
