//! The claims about motion, frames and coordinates reject what is broken in just their way, and pass what is sound.

use glam::{DVec2, DVec3};
use hashed_alpha::check::claims::{self, Claim};
use hashed_alpha::check::specimen::{self, Ideal, ideal};
use hashed_alpha::check::{Budget, Draw, Outcome, Subject, Verdict, run_claims, subject::Precision};
use hashed_alpha::scene::Fragment;
use hashed_alpha::threshold::cdf::{CdfForm, cdf};
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::{Cell, Hash, HashKind};
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::two_scale::Variant;
use std::num::NonZeroU32;

const FAMILIES: [&str; 5] = ["flips.", "frames.", "coordinates.", "determinism.", "symmetry."];

/// Listing 1 over the ideal source.
fn sound() -> HashedAlpha<Ideal> {
    HashedAlpha { variant: Variant::Isotropic, hash: Ideal::new(0), hash_scale: 1.0, form: CdfForm::Stable }
}

fn mine() -> Vec<Claim> {
    let is_mine = |claim: &Claim| {
        FAMILIES.iter().any(|family| claim.id.starts_with(family)) || claim.id == "layers.quarter"
    };
    claims::ALL.iter().copied().filter(is_mine).collect()
}

/// Tries a subject and asserts that `claim` rejects it even with the fewest samples.
fn assert_rejected_by(claim: &str, subject: Subject<'_>) {
    let claim = claims::ALL.iter().copied().find(|known| known.id == claim).expect("a claim of that name");
    let draw = Draw { budget: Budget::Quick, ..Draw::default() };
    let [outcome] = &run_claims(&[claim], &[subject], &draw, || {})[..] else {
        panic!("one claim, one outcome")
    };
    assert_eq!(outcome.verdict, Verdict::Rejected, "{outcome}");
    assert!(outcome.finding.as_ref().is_some_and(|finding| !finding.is_empty()), "{outcome}");
}

fn isotropic(threshold: impl Fn(&Footprint<f64>) -> f64 + Send + Sync + 'static) -> Subject<'static> {
    Subject::new("specimen", Precision::F64, Variant::Isotropic, threshold)
}

fn of_fragments(threshold: impl Fn(&Fragment) -> f64 + Send + Sync + 'static) -> Subject<'static> {
    Subject::of_fragments("specimen", Precision::F64, Variant::Isotropic, threshold)
}

fn frames(n: u32) -> NonZeroU32 {
    NonZeroU32::new(n).expect("not zero")
}

/// A hash of whatever a shader may take for a place.
fn hash_of(place: DVec3, salt: u32) -> f64 {
    HashKind::Mm4.hash(&Cell { index: place.floor(), octave: salt })
}

/// Every join of both variants, static and over frames.
fn sound_subjects(precision: Precision) -> Vec<Subject<'static>> {
    let mut subjects = Vec::new();
    for variant in [Variant::Isotropic, Variant::Anisotropic] {
        for join in Join::ALL {
            let robust = Robust { join, ..Robust::new(variant) };
            let subject = || Subject::robust(format!("{variant} {join}"), precision, robust);
            subjects.extend([subject(), subject().stratified(frames(8))]);
        }
    }
    subjects
}

fn assert_all_pass(subjects: &[Subject<'_>], draw: &Draw) -> Vec<Outcome> {
    let outcomes = run_claims(&mine(), subjects, draw, || {});
    let failed: Vec<String> =
        outcomes.iter().filter(|outcome| !outcome.as_expected()).map(ToString::to_string).collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    outcomes
}

#[test]
fn what_is_sound_passes() {
    let mut subjects = sound_subjects(Precision::F64);
    subjects
        .push(Subject::robust("odd", Precision::F32, Robust::new(Variant::Isotropic)).stratified(frames(7)));
    subjects.push(ideal(1, Variant::Isotropic, Precision::F64, Join::Interpolate));
    assert_all_pass(&subjects, &Draw::default());
}

#[test]
fn no_sound_subject_is_left_without_an_answer_at_the_smallest_budget() {
    let draw = Draw { budget: Budget::Quick, seed: 1, round: 0 };
    for outcome in assert_all_pass(&sound_subjects(Precision::F32), &draw) {
        let spreads = outcome.subject.ends_with("8 frames");
        let about_others = match outcome.check {
            "frames.stratified" | "frames.average" => !spreads,
            "frames.static" | "frames.serial" => spreads,
            _ => false,
        };
        assert_eq!(outcome.verdict == Verdict::NotApplicable, about_others, "{outcome}");
    }
}

fn salted(cell: &Cell<f64>, salt: u32) -> f64 {
    Ideal::new(0).hash(&Cell { octave: salt, ..*cell })
}

/// Hashes the fine cell twice: whatever leaves it is drawn anew.
fn every_change_is_hard() -> Subject<'static> {
    isotropic(|footprint| {
        let found = Variant::Isotropic.two_scale(footprint, 1.0);
        let [first, second] = [1, 2].map(|salt| salted(&found.ceil_cell, salt));
        cdf((1.0 - found.lerp_factor) * first + found.lerp_factor * second, found.lerp_factor)
    })
}

#[test]
fn a_fine_cell_that_decides_alone_flips_too_much() {
    assert_rejected_by("flips.translation", every_change_is_hard());
}

/// Interpolates without Eq. 2: fewer flips under zoom than a uniform threshold has to have.
fn without_cdf() -> Subject<'static> {
    isotropic(|footprint| sound().trace(footprint).interpolated)
}

#[test]
fn without_the_cdf_zoom_flips_too_little() {
    assert_rejected_by("flips.zoom", without_cdf());
    assert_rejected_by("flips.translation", without_cdf());
}

/// Measures the derivative along x alone.
fn one_derivative() -> Subject<'static> {
    isotropic(|footprint| sound().threshold(&Footprint { dpdy: DVec3::ZERO, ..*footprint }))
}

/// Takes the shorter of the derivatives.
fn shorter_derivative() -> Subject<'static> {
    isotropic(|footprint| {
        let shorter = [footprint.dpdx, footprint.dpdy]
            .into_iter()
            .min_by(|a, b| a.length().total_cmp(&b.length()))
            .expect("two of them");
        sound().threshold(&Footprint { dpdx: shorter, dpdy: shorter, ..*footprint })
    })
}

#[test]
fn another_scale_flips_at_other_times() {
    assert_rejected_by("flips.rotation", one_derivative());
    assert_rejected_by("flips.tilt", one_derivative());
    assert_rejected_by("flips.tilt", shorter_derivative());
}

/// Hashes the position after skinning and deformation.
fn deformed_position() -> Subject<'static> {
    of_fragments(|fragment| sound().threshold(&Footprint { position: fragment.world, ..fragment.footprint }))
}

/// Hashes eye coordinates.
fn eye_position() -> Subject<'static> {
    of_fragments(|fragment| sound().threshold(&Footprint { position: fragment.eye, ..fragment.footprint }))
}

/// Hashes the pixel: every layer has the same noise.
fn screen_door() -> Subject<'static> {
    of_fragments(|fragment| hash_of(fragment.pixel.extend(0.0), 0))
}

/// Hashes the texel of a texture that is repeated eight times.
fn tiled_texel() -> Subject<'static> {
    of_fragments(|fragment| {
        let tile: DVec2 = fragment.texcoord * 8.0;
        hash_of(((tile - tile.floor()) * 1024.0).extend(0.0), 0)
    })
}

#[test]
fn what_is_not_of_the_object_does_not_stay_on_it() {
    for broken in [deformed_position(), eye_position(), screen_door()] {
        assert_rejected_by("coordinates.object", broken);
    }
    assert_rejected_by("flips.skinning", deformed_position());
    assert_rejected_by("flips.skinning", eye_position());
}

#[test]
fn layers_that_share_their_noise_hide_each_other() {
    assert_rejected_by("layers.quarter", screen_door());
}

#[test]
fn a_repeated_texture_is_no_noise_of_its_own_for_every_place() {
    assert_rejected_by("layers.parallel", tiled_texel());
    assert_rejected_by("independence.octaves", tiled_texel());
}

#[test]
fn derivatives_have_no_sign_and_no_order() {
    let by_diagonal = |sign: f64| {
        isotropic(move |footprint| {
            let diagonal = footprint.dpdx + footprint.dpdy * sign;
            sound().threshold(&Footprint { dpdx: diagonal, dpdy: DVec3::ZERO, ..*footprint })
        })
    };
    assert_rejected_by("symmetry.derivatives", by_diagonal(1.0));
    assert_rejected_by("symmetry.derivatives", one_derivative());
}

/// Noise of twice the size that it claims.
fn twice_the_size() -> Subject<'static> {
    isotropic(|footprint| HashedAlpha { hash_scale: 2.0, ..sound() }.threshold(footprint))
}

#[test]
fn noise_of_twice_the_size_stays_too_long_at_a_pixel() {
    assert_rejected_by("frames.serial", twice_the_size());
}

/// The order of the strata alone is wrong: each is taken once.
#[test]
fn strata_in_an_order_that_depends_on_the_threshold_are_strata() {
    let by_threshold = specimen::ALL.iter().find(|specimen| specimen.name == "order-by-threshold").unwrap();
    let outcomes =
        run_claims(&[claims::frames::STRATIFIED], &[(by_threshold.subject)()], &Draw::default(), || {});
    assert_eq!(outcomes[0].verdict, Verdict::Consistent, "{}", outcomes[0]);
}
