//! Nothing sound is rejected: the robust threshold with several hashes and joins, shader files of both languages, and
//! thresholds that are stored in few bits.
//!
//! `HASHED_ALPHA_BUDGET=nightly` tries the sound subjects in a hundred runs of [`Budget::Ci`]; otherwise each is tried once
//! at [`Budget::Quick`].

use crate::budget::budget;
use hashed_alpha::check::shaders::interpreted;
use hashed_alpha::check::{Budget, Draw, Precision, Standing, Subject, claims, run_claims};
use hashed_alpha::shader::export::{self, export};
use hashed_alpha::shader::interpreter::DeviceModel;
use hashed_alpha::shader::own;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::two_scale::Variant;
use std::num::NonZeroU32;

/// Noise of fewer than 22 bits is refused by this claim, as the documentation says.
const POLICY: &str = "hash.values";

fn quantised(variant: Variant, stored: fn(f32) -> f32) -> Subject<'static> {
    let robust = Robust::new(variant);
    let threshold = move |at: &Footprint<f64>| {
        let found = robust.threshold::<f32>(&at.cast()).ok()?;
        Some(f64::from(stored(found)))
    };
    let mut subject = Subject::new("quantised", Precision::F32, variant, threshold);
    (subject.join, subject.nested_phase) = (robust.join, true);
    subject
}

#[test]
fn a_threshold_of_sixteen_bits_or_in_half_floats_is_sound() {
    // The smallest value that can be stored takes the place of 0, which would keep what is wholly transparent.
    let fixed: fn(f32) -> f32 = |x| (x * 65_536.0).round().max(1.0) / 65_536.0;
    let half: fn(f32) -> f32 = |x| half::f16::from_f32(x).max(half::f16::MIN_POSITIVE_SUBNORMAL).to_f32();
    let subjects = [quantised(Variant::Isotropic, fixed), quantised(Variant::Anisotropic, half)];
    let draw = Draw { budget: Budget::Quick, ..Draw::default() };
    for outcome in run_claims(claims::ALL, &subjects, &draw, || {}) {
        let is_policy = outcome.check == POLICY;
        assert_eq!(outcome.standing() == Standing::Against, is_policy, "{outcome}");
        assert_ne!(outcome.standing(), Standing::Unanswered, "{outcome}");
    }
}

const fn robust(hash: HashKind, variant: Variant, join: Join) -> Robust<HashKind> {
    Robust { hash, join, ..Robust::new(variant) }
}

/// The threshold as a shader file that is written and read back, on the interpreter.
fn shader(written: export::Language, read: own::Language, twin: Robust<HashKind>) -> Subject<'static> {
    let text = export(twin, written).expect("what can be written").into_bytes();
    let shader = own::parse(written.name(), read, &text, &own::Options::default()).expect("a shader");
    let name = format!("shader in {written}");
    let mut subject =
        interpreted(name, &shader, DeviceModel::ACCURATE, twin.variant).expect("what is interpreted");
    (subject.join, subject.nested_phase) = (twin.join, true);
    subject
}

/// Four hashes, three joins, both precisions and both shading languages; two of them over frames.
fn sound() -> [Subject<'static>; 8] {
    use {HashKind as H, Join as J, Precision as P, Variant as V};
    let of = |precision, twin: Robust<HashKind>| {
        let Robust { hash, variant, join, .. } = twin;
        Subject::robust(format!("{variant} {hash} {join}"), precision, twin)
    };
    let frames = |count| NonZeroU32::new(count).expect("not zero");
    [
        of(P::F32, robust(H::Mm4, V::Isotropic, J::Interpolate)),
        of(P::F64, robust(H::Pcg4d, V::Anisotropic, J::Copula)),
        of(P::F32, robust(H::Xxhash32, V::Isotropic, J::Copula)),
        of(P::F32, robust(H::PcgNested, V::Anisotropic, J::Dithered)).stratified(frames(5)),
        of(P::F64, robust(H::Xxhash32, V::Isotropic, J::Dithered)),
        of(P::F32, robust(H::Pcg4d, V::Isotropic, J::Dithered)).stratified(frames(8)),
        shader(
            export::Language::Wgsl,
            own::Language::Wgsl,
            robust(H::PcgNested, V::Isotropic, J::Interpolate),
        ),
        shader(export::Language::Glsl, own::Language::Glsl, robust(H::Mm4, V::Anisotropic, J::Dithered)),
    ]
}

/// The runs are the subjects in turn, each with a seed of its own.
#[test]
fn sound_hashes_joins_and_shader_files_are_never_rejected() {
    let subjects = sound();
    let (runs, checked) = budget().pick((8, Budget::Quick), (8, Budget::Quick), (100, Budget::Ci));
    let mut alarms = Vec::new();
    for run in 0..runs {
        let subject = &subjects[run % subjects.len()];
        let draw = Draw { seed: run as u64, budget: checked, ..Draw::default() };
        let outcomes = run_claims(claims::ALL, std::slice::from_ref(subject), &draw, || {});
        let answers = outcomes.iter().filter(|outcome| outcome.standing() != Standing::NotApplicable);
        assert!(answers.count() > claims::ALL.len() * 3 / 4, "{} has few answers", subject.name);
        let wrong = outcomes.iter().filter(|outcome| outcome.standing().is_news());
        alarms.extend(wrong.map(|outcome| format!("run {run}: {outcome}")));
    }
    assert!(alarms.is_empty(), "{}", alarms.join("\n"));
}

/// Hashes that shaders use and that are not uniform on every plane, in whatever join.
const WEAK: [HashKind; 5] =
    [HashKind::Tea3, HashKind::Superfast, HashKind::Fnv1a, HashKind::Teschner, HashKind::Weyl];

/// The joined threshold is uniform only where the hashes that go into it, the choosing one among them, do not know of each
/// other: that depends on the pair of hash and join. The variants take turns.
#[test]
fn every_hash_that_tells_octaves_apart_is_uniform_in_every_join() {
    let uniform: Vec<_> =
        claims::ALL.iter().filter(|claim| claim.id.starts_with("uniform.")).copied().collect();
    let draw = Draw { budget: Budget::Quick, ..Draw::default() };
    let hashes = HashKind::ALL.into_iter().filter(|hash| hash.is_exact() && hash.reads_octave());
    let mut wrong = Vec::new();
    for (number, hash) in hashes.enumerate() {
        let mut rejections = Vec::new();
        for (turn, join) in Join::ALL.into_iter().enumerate() {
            let variant = [Variant::Isotropic, Variant::Anisotropic][(number + turn) % 2];
            let name = format!("{variant} {hash} {join}");
            let subject = Subject::robust(name.as_str(), Precision::F32, robust(hash, variant, join));
            let outcomes = run_claims(&uniform, &[subject], &draw, || {});
            let news = outcomes.iter().filter(|outcome| outcome.standing().is_news());
            rejections.extend(news.map(|outcome| format!("{name}: {outcome}")));
        }
        if !WEAK.contains(&hash) {
            wrong.append(&mut rejections);
        } else if rejections.is_empty() {
            wrong.push(format!("{hash} is in the list of weak hashes, and was rejected nowhere"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
