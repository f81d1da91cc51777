//! Wrong from frame to frame, from pass to pass, from layer to layer.

use super::defect::Specimen;
use super::port::{Port, SOUND, ideal_hash};
use crate::check::subject::Precision;
use crate::check::{Frames, Subject};
use crate::scene::Fragment;
use crate::threshold::footprint::Footprint;
use crate::threshold::stage::stratify::{alternating, alternating_literal, stratified};
use crate::threshold::two_scale::Variant;
use core::num::NonZeroU32;
use glam::DVec3;

/// The sound port with the seed of the frame in its position.
const SEEDED: Port = Port {
    read: |at| {
        let shift = DVec3::splat(64.0 * f64::from(at.frame % 64));
        Footprint { position: at.footprint.position + shift, ..at.footprint }
    },
    ..SOUND
};

/// Spreads the sound threshold chi over 1 + `last` frames by a rule of chi, the frame and their number.
fn spread(last: u32, rule: fn(f64, u32, NonZeroU32) -> f64) -> Subject<'static> {
    let sound = SOUND.subject();
    let count = NonZeroU32::MIN.saturating_add(last);
    let threshold = move |at: &Fragment| {
        let chi = sound.threshold(Fragment { frame: 0, ..*at })?;
        Some(rule(chi, at.frame % count, count))
    };
    let mut subject = Subject::of_fragments("specimen", Precision::F64, Variant::Isotropic, threshold);
    (subject.nested_phase, subject.frames) = (true, Frames::Strata(count));
    subject
}

pub(super) const FAMILY: &[Specimen] = &[
    Specimen {
        name: "layer-in-the-seed",
        defect: "the second bit of the layer is part of the hash, so a surface changes its noise with what lies before it",
        mend: "hash the cell alone",
        claim: "determinism.arguments",
        subject: || {
            Port {
                read: |at| {
                    let shift = DVec3::splat(64.0 * f64::from(at.layer >> 1 & 1));
                    Footprint { position: at.footprint.position + shift, ..at.footprint }
                },
                ..SOUND
            }
            .subject()
        },
    },
    Specimen {
        name: "tile-in-the-seed",
        defect: "each repeat of the texture has noise of its own, and so every seam a tear",
        mend: "hash the cell alone",
        claim: "determinism.arguments",
        subject: || {
            Port {
                read: |at| {
                    let shift = DVec3::new(64.0 * at.texcoord.x.floor(), 0.0, 0.0);
                    Footprint { position: at.footprint.position + shift, ..at.footprint }
                },
                ..SOUND
            }
            .subject()
        },
    },
    Specimen {
        name: "frame-seed",
        defect: "the index of the frame is part of the hash, so the noise is drawn anew in every frame",
        mend: "hash the cell alone, or spread thresholds over frames by Eq. 6",
        claim: "frames.static",
        subject: || SEEDED.subject(),
    },
    Specimen {
        name: "frames-drawn-anew",
        defect: "thresholds are drawn anew in each of eight frames instead of taking one stratum each",
        mend: "add j / n to one threshold and take the part after the point (Eq. 6)",
        claim: "frames.stratified",
        subject: || {
            let mut subject = SEEDED.subject();
            subject.frames = Frames::Strata(NonZeroU32::MIN.saturating_add(7));
            subject
        },
    },
    Specimen {
        name: "sequence-drawn-anew",
        defect: "thresholds are said to go through a sequence of frames, and are drawn anew in each",
        mend: "add the same number to all thresholds of a frame, frame * 0.618034, and take the part after the point",
        claim: "frames.sequence",
        subject: || {
            let mut subject = SEEDED.subject();
            subject.frames = Frames::Sequence;
            subject
        },
    },
    Specimen {
        name: "sequence-of-short-steps",
        defect: "the step from frame to frame is 0.1: ten frames and no more differ, with gaps between them for whatever history",
        mend: "take a step whose multiples fill the interval, 0.618034",
        claim: "frames.sequence",
        subject: || {
            let sound = SOUND.subject();
            let threshold = move |at: &Fragment| {
                let chi = sound.threshold(Fragment { frame: 0, ..*at })?;
                let moved = chi + 0.1 * f64::from(at.frame);
                Some(1.0 - (1.0 - moved).rem_euclid(1.0))
            };
            let mut subject =
                Subject::of_fragments("specimen", Precision::F64, Variant::Isotropic, threshold);
            (subject.nested_phase, subject.frames) = (true, Frames::Sequence);
            subject
        },
    },
    Specimen {
        name: "odd-number-of-frames",
        defect: "seven frames in the order i / 2 + (i mod 2) n / 2, which repeats a stratum and leaves another out",
        mend: "round half of an odd number of frames up, or take an even number",
        claim: "frames.stratified",
        subject: || spread(6, |chi, frame, n| stratified(chi, alternating_literal(frame, n), n)),
    },
    Specimen {
        name: "frame-through-f32",
        defect: "the frame becomes a number of 24 bits before its stratum is taken: from frame 2^24 on strata are left out",
        mend: "take the frame modulo the number of strata in whole numbers",
        claim: "frames.stratified",
        subject: || {
            let sound = SOUND.subject();
            let count = NonZeroU32::MIN.saturating_add(7);
            let threshold = move |at: &Fragment| {
                let chi = sound.threshold(Fragment { frame: 0, ..*at })?;
                Some(stratified(chi, alternating(at.frame as f32 as u32, count), count))
            };
            let mut subject =
                Subject::of_fragments("specimen", Precision::F64, Variant::Isotropic, threshold);
            (subject.nested_phase, subject.frames) = (true, Frames::Strata(count));
            subject
        },
    },
    Specimen {
        name: "order-by-threshold",
        defect: "fragments whose threshold is above 1/2 take the strata backwards, so that their average is biased",
        mend: "take the strata in one order everywhere",
        claim: "frames.average",
        subject: || {
            spread(7, |chi, frame, n| {
                let at = if chi > 0.5 { n.get() - frame } else { frame };
                stratified(chi, at, n)
            })
        },
    },
    Specimen {
        name: "strata-of-twice-the-frames",
        defect: "the strata of sixteen frames over eight, which leaves out half of the thresholds of a pixel",
        mend: "divide by the number of frames over which thresholds are spread",
        claim: "frames.stratified",
        subject: || {
            spread(7, |chi, frame, n| {
                let twice = n.saturating_mul(NonZeroU32::MIN.saturating_add(1));
                stratified(chi, alternating(frame, n), twice)
            })
        },
    },
    Specimen {
        name: "neighbouring-lane",
        defect: "the last of 64 lanes takes the threshold of the one before it, so a second pass decides otherwise",
        mend: "compute each lane from its own inputs",
        claim: "determinism.two_passes",
        subject: || {
            let sound = SOUND.subject();
            let mut subject =
                Subject::batched("specimen", Precision::F64, Variant::Isotropic, move |fragments| {
                    let lane = |at: usize| sound.threshold(fragments[at - usize::from(at % 64 == 63)]);
                    Ok((0..fragments.len()).map(|at| lane(at).unwrap_or(f64::NAN)).collect())
                });
            subject.nested_phase = true;
            subject
        },
    },
    Specimen {
        name: "four-layers",
        defect: "the pixel is hashed with one of four salts for its layer, so every fifth layer repeats the first",
        mend: "hash the position in object coordinates",
        claim: "layers.quarter",
        subject: || {
            let threshold = |at: &Fragment| {
                let [x, y] = at.pixel.floor().to_array();
                ideal_hash([x, y, f64::from(at.layer % 4)], 0)
            };
            Subject::of_fragments("specimen", Precision::F64, Variant::Isotropic, threshold)
        },
    },
];
