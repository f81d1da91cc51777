//! The claims about noise as a whole reject what is broken in just their way, and pass what is sound; and two subjects
//! are told apart no further than they differ.

use glam::{DVec3, Vec3Swizzles};
use hashed_alpha::check::claims::{self, Claim};
use hashed_alpha::check::specimen::Ideal;
use hashed_alpha::check::{Agreement, Draw, Subject, Verdict, compare, run_claims, subject::Precision};
use hashed_alpha::scene::Fragment;
use hashed_alpha::threshold::cdf::{CdfForm, cdf};
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::{Cell, Hash, HashKind};
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::two_scale::Variant;
use std::f64::consts::TAU;

const NOISE: [&str; 7] = [
    "noise_scale.",
    "spectrum.",
    "coverage.",
    "uniform.constant_x",
    "uniform.constant_y",
    "uniform.constant_z",
    "uniform.any_plane",
];

fn noise() -> Vec<Claim> {
    let is_noise = |claim: &Claim| NOISE.iter().any(|family| claim.id.starts_with(family));
    claims::ALL.iter().copied().filter(is_noise).collect()
}

fn robust(variant: Variant, hash_scale: f64) -> Robust<Ideal> {
    let Robust { join, repairs, .. } = Robust::new(variant);
    Robust { variant, hash: Ideal::new(0), hash_scale, join, repairs }
}

fn claim_named(id: &str) -> Claim {
    claims::ALL.iter().copied().find(|claim| claim.id == id).expect("a claim of that name")
}

fn assert_rejected_by(claim: &str, subject: Subject<'_>) {
    let [outcome] = &run_claims(&[claim_named(claim)], &[subject], &Draw::default(), || {})[..] else {
        panic!("one claim, one outcome")
    };
    assert_eq!(outcome.verdict, Verdict::Rejected, "{outcome:?}");
    assert!(outcome.finding.as_ref().is_some_and(|finding| !finding.is_empty()), "{outcome:?}");
}

fn isotropic(threshold: impl Fn(&Footprint<f64>) -> f64 + Send + Sync + 'static) -> Subject<'static> {
    Subject::new("specimen", Precision::F64, Variant::Isotropic, threshold)
}

/// The sound threshold at a footprint, under the name of another.
fn evaluated(robust: &Robust<Ideal>, footprint: &Footprint<f64>) -> f64 {
    robust.threshold(footprint).expect("finite input")
}

#[test]
fn an_ideal_source_passes_with_every_join() {
    for variant in [Variant::Isotropic, Variant::Anisotropic] {
        for join in Join::ALL {
            let ideal = Robust { join, ..robust(variant, 1.0) };
            let subject = Subject::robust("ideal", Precision::F64, ideal);
            for outcome in run_claims(&noise(), &[subject], &Draw::default(), || {}) {
                assert!(outcome.as_expected(), "{variant} {join}: {outcome:?}");
            }
        }
    }
}

#[test]
fn an_ideal_source_passes_at_another_size() {
    let hash_scale = 2.5;
    let subject = Subject::robust("ideal", Precision::F32, robust(Variant::Anisotropic, hash_scale));
    for outcome in run_claims(&noise(), &[subject], &Draw::default(), || {}) {
        assert!(outcome.as_expected(), "{hash_scale}: {outcome:?}");
    }
}

/// Claims one size of the noise and has another.
fn specimen_of_another_size(variant: Variant, claimed: f64, actual: f64) -> Subject<'static> {
    let broken = robust(variant, actual);
    let mut subject =
        Subject::new("specimen", Precision::F64, variant, move |footprint| evaluated(&broken, footprint));
    subject.hash_scale = claimed;
    subject.join = broken.join;
    subject
}

/// `1 / h` where `h` is meant.
fn specimen_hash_scale_inverted() -> Subject<'static> {
    specimen_of_another_size(Variant::Isotropic, 2.0, 0.5)
}

/// `h * h` where `h` is meant.
fn specimen_hash_scale_squared() -> Subject<'static> {
    specimen_of_another_size(Variant::Isotropic, 2.0, 4.0)
}

/// Listing 2 without the 0.707.
fn specimen_without_diagonal() -> Subject<'static> {
    specimen_of_another_size(Variant::Anisotropic, 1.0, 0.707)
}

/// The derivative along screen x in both places.
fn specimen_dpdx_twice() -> Subject<'static> {
    let sound = robust(Variant::Isotropic, 1.0);
    isotropic(move |footprint| evaluated(&sound, &Footprint { dpdy: footprint.dpdx, ..*footprint }))
}

/// Listing 2 with the derivatives of the wrong axis.
fn specimen_axes_exchanged() -> Subject<'static> {
    let sound = robust(Variant::Anisotropic, 1.0);
    let mut subject = Subject::new("specimen", Precision::F64, Variant::Anisotropic, move |footprint| {
        let Footprint { position, dpdx, dpdy } = *footprint;
        evaluated(&sound, &Footprint { position, dpdx: dpdx.zxy(), dpdy: dpdy.zxy() })
    });
    subject.join = sound.join;
    subject
}

#[test]
fn noise_of_another_size_is_seen() {
    for specimen in [specimen_hash_scale_inverted, specimen_hash_scale_squared, specimen_without_diagonal] {
        assert_rejected_by("noise_scale.frontal", specimen());
        assert_rejected_by("noise_scale.tilted", specimen());
        assert_rejected_by("spectrum.autocorrelation", specimen());
        assert_rejected_by("spectrum.radial", specimen());
    }
}

#[test]
fn a_derivative_in_the_wrong_place_is_seen_on_a_tilted_surface() {
    assert_rejected_by("noise_scale.tilted", specimen_dpdx_twice());
    assert_rejected_by("spectrum.anisotropy", specimen_dpdx_twice());
    assert_rejected_by("noise_scale.tilted", specimen_axes_exchanged());
    assert_rejected_by("spectrum.autocorrelation", specimen_axes_exchanged());
}

/// The weights of the two octaves exchanged: uniform at every lerp factor, since Eq. 2 does not tell them apart.
fn specimen_weights_exchanged() -> Subject<'static> {
    isotropic(|footprint| {
        let found = Variant::Isotropic.two_scale(footprint, 1.0);
        let (coarse, fine): (f64, f64) =
            (Ideal::new(0).hash(&found.floor_cell), Ideal::new(0).hash(&found.ceil_cell));
        cdf(found.lerp_factor * coarse + (1.0 - found.lerp_factor) * fine, found.lerp_factor).max(1e-6)
    })
}

#[test]
fn exchanged_weights_are_seen_in_what_neighbours_share() {
    assert_rejected_by("spectrum.autocorrelation", specimen_weights_exchanged());
    assert_rejected_by("spectrum.radial", specimen_weights_exchanged());
}

/// White noise: every pixel has a draw of its own.
fn specimen_white_noise() -> Subject<'static> {
    isotropic(|footprint| {
        let position = (footprint.position * 1e6).floor();
        Ideal::new(0).hash(&Cell::<f64> { index: position, octave: 0 })
    })
}

/// Hashes two coordinates of three: cells are columns.
#[derive(Clone, Copy)]
struct Columns;

impl<R: Real> Hash<R> for Columns {
    fn hash(&self, cell: &Cell<R>) -> R {
        let [x, y, _] = cell.index.into();
        Ideal::new(0).hash(&Cell { index: [x, y, R::from_f64(0.0)].into(), octave: cell.octave })
    }
}

fn specimen_two_coordinates() -> Subject<'static> {
    let listing =
        HashedAlpha { variant: Variant::Isotropic, hash: Columns, hash_scale: 1.0, form: CdfForm::Stable };
    Subject::hashed("specimen", Precision::F64, listing)
}

/// A multiple of the golden ratio for each cell: neighbours avoid each other.
#[derive(Clone, Copy)]
struct LowDiscrepancy;

impl<R: Real> Hash<R> for LowDiscrepancy {
    fn hash(&self, cell: &Cell<R>) -> R {
        let [x, y, z] = cell.index.into().map(R::to_f64);
        let phase: f64 = Ideal::new(0).hash(&Cell::<f64> { index: DVec3::ZERO, octave: cell.octave });
        let value = 0.819_172_5 * x + 0.671_043_6 * y + 0.549_700_5 * z + phase;
        R::from_f64(value - value.floor())
    }
}

fn specimen_ordered() -> Subject<'static> {
    let hash = LowDiscrepancy;
    let listing = HashedAlpha { variant: Variant::Isotropic, hash, hash_scale: 1.0, form: CdfForm::Stable };
    Subject::hashed("specimen", Precision::F64, listing)
}

#[test]
fn clumps_and_too_even_noise_are_both_seen() {
    for specimen in [specimen_white_noise, specimen_two_coordinates, specimen_ordered] {
        assert_rejected_by("coverage.variance", specimen());
        assert_rejected_by("spectrum.autocorrelation", specimen());
    }
    assert_rejected_by("spectrum.ordinates", specimen_ordered());
    assert_rejected_by("spectrum.ordinates", specimen_white_noise());
}

/// A wave across the screen, added modulo 1: still uniform everywhere.
fn specimen_tone() -> Subject<'static> {
    let sound = robust(Variant::Isotropic, 1.0);
    Subject::of_fragments("specimen", Precision::F64, Variant::Isotropic, move |fragment: &Fragment| {
        let wave = 0.25 * libm::sin(TAU * 0.31 * fragment.pixel.x);
        let value = evaluated(&sound, &fragment.footprint) + wave;
        value - value.floor()
    })
}

#[test]
fn a_tone_is_seen() {
    assert_rejected_by("spectrum.ordinates", specimen_tone());
}

/// Too sparse on one surface, too dense on the other.
fn specimen_opposite_biases(flips: fn(&Footprint<f64>) -> bool) -> Subject<'static> {
    let sound = robust(Variant::Isotropic, 1.0);
    isotropic(move |footprint| {
        let threshold = evaluated(&sound, footprint);
        if flips(footprint) { libm::pow(threshold, 1.15) } else { libm::pow(threshold, 1.0 / 1.15) }
    })
}

#[test]
fn biases_that_cancel_in_the_pool_are_seen_on_their_surfaces() {
    let grazing = |footprint: &Footprint<f64>| footprint.dpdy.length() > 2.0 * footprint.dpdx.length();
    assert_rejected_by("coverage.mean", specimen_opposite_biases(grazing));
    let upright = |footprint: &Footprint<f64>| footprint.dpdx.z == 0.0;
    assert_rejected_by("coverage.mean_aligned", specimen_opposite_biases(upright));
}

/// Hashes two coordinates into 4096 values before the third comes in.
#[derive(Clone, Copy)]
struct FewValues(usize);

impl<R: Real> Hash<R> for FewValues {
    fn hash(&self, cell: &Cell<R>) -> R {
        let zero = R::from_f64(0.0);
        let mut index = cell.index.into();
        let last = core::mem::replace(&mut index[self.0], zero);
        let inner: R = HashKind::Mm4.hash(&Cell { index: index.into(), octave: 0 });
        HashKind::Mm4
            .hash(&Cell { index: [(inner * R::from_f64(4096.0)).floor(), zero, last].into(), octave: 0 })
    }
}

fn specimen_few_values(axis: usize) -> Subject<'static> {
    let hash = FewValues(axis);
    let listing = HashedAlpha { variant: Variant::Isotropic, hash, hash_scale: 1.0, form: CdfForm::Stable };
    Subject::hashed("specimen", Precision::F64, listing)
}

/// A gamma that drifts slowly through space: one surface is too dense, another one too sparse.
fn specimen_drifting() -> Subject<'static> {
    let sound = robust(Variant::Isotropic, 1.0);
    isotropic(move |footprint| {
        let phase = footprint.position.dot(DVec3::new(0.13, 0.11, -0.12));
        libm::pow(evaluated(&sound, footprint), 1.0 + 0.1 * libm::sin(phase))
    })
}

#[test]
fn single_planes_show_their_bias() {
    for (axis, claim) in ["uniform.constant_x", "uniform.constant_y", "uniform.constant_z"].iter().enumerate()
    {
        assert_rejected_by(claim, specimen_few_values(axis));
    }
    assert_rejected_by("uniform.any_plane", specimen_drifting());
}

#[test]
fn two_subjects_agree_as_far_as_they_do() {
    let listing = |precision, form| {
        let hashed = HashedAlpha { form, ..HashedAlpha::listing(Variant::Isotropic) };
        Subject::hashed(format!("{form} {precision}"), precision, hashed)
    };
    let by = |hash| {
        let robust = Robust { hash, ..Robust::new(Variant::Isotropic) };
        Subject::robust::<HashKind>("robust", Precision::F64, robust)
    };
    let agreement = |a: &Subject<'_>, b: &Subject<'_>| compare(a, b, &Draw::default()).expect("both run");
    let (f32, f64) = (Precision::F32, Precision::F64);
    let (literal, stable) = (listing(f64, CdfForm::Literal), listing(f64, CdfForm::Stable));

    let same = agreement(&literal, &literal);
    assert_eq!((same.agreement, same.share_equal, same.largest_difference), (Agreement::Equal, 1.0, 0.0));
    let rounding = agreement(&literal, &stable);
    assert_eq!(rounding.agreement, Agreement::EqualWithin);
    assert!(rounding.share_equal < 1.0 && rounding.largest_difference < 1e-12, "{rounding:?}");
    // The sine of large arguments: hardly a digit in common.
    let sines = agreement(&listing(f32, CdfForm::Stable), &stable);
    assert_eq!(sines.agreement, Agreement::SameLaw, "{sines:?}");
    assert!(sines.share_within < 0.5, "{sines:?}");
    assert_eq!(agreement(&by(HashKind::Mm4), &by(HashKind::Pcg4d)).agreement, Agreement::SameLaw);
    // A law that is the same one where it is pooled, and another at every lerp factor.
    let uncorrected =
        isotropic(|footprint| HashedAlpha::listing(Variant::Isotropic).trace(footprint).interpolated);
    assert_eq!(agreement(&stable, &uncorrected).agreement, Agreement::DifferentLaws);
    let refusing = isotropic(|footprint| if footprint.position.x > 0.0 { f64::NAN } else { 0.5 });
    let refused = agreement(&stable, &refusing);
    assert_eq!(refused.agreement, Agreement::DifferentLaws);
    assert!(refused.refused[1] > 0 && refused.largest_difference == f64::INFINITY, "{refused:?}");
    let broken = Subject::batched("gone", f64, Variant::Isotropic, |_| Err("device lost".into()));
    assert!(compare(&stable, &broken, &Draw::default()).unwrap_err().contains("device lost"));
}
