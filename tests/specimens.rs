//! Every claim rejects a threshold that is broken in just its way, and an ideal one passes them all.

mod ideal;

use hashed_alpha::check::claims::{self, Claim};
use hashed_alpha::check::{Draw, Outcome, Subject, Verdict, run_claims, subject::Precision};
use hashed_alpha::threshold::cdf;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::{Cell, Hash, HashKind};
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::real::Real;
use hashed_alpha::threshold::robust::{Repair, Repairs, Robust};
use hashed_alpha::threshold::two_scale::Variant;
use ideal::Ideal;

const SOUND: HashedAlpha<Ideal> = sound(Ideal);

/// Listing 1 with Eq. 2 in its stable form and a hash of one's own.
const fn sound<H>(hash: H) -> HashedAlpha<H> {
    HashedAlpha { variant: Variant::Isotropic, hash, hash_scale: 1.0, form: cdf::CdfForm::Stable }
}

fn claims_that_fail(outcomes: &[Outcome]) -> Vec<&'static str> {
    outcomes.iter().filter(|outcome| !outcome.as_expected()).map(|outcome| outcome.check).collect()
}

fn claim_named(id: &str) -> Claim {
    claims::ALL.iter().copied().find(|claim| claim.id == id).expect("a claim of that name")
}

/// Tries a specimen and asserts that `claim` rejects it.
fn assert_rejected_by(claim: &str, specimen: impl Fn(&Footprint<f64>) -> f64 + Send + Sync) {
    assert_rejects(claim, Subject::new("specimen", Precision::F64, Variant::Isotropic, specimen));
}

/// Tries a subject and asserts that `claim` rejects it.
fn assert_rejects(claim: &str, subject: Subject<'_>) {
    let [outcome] = &run_claims(&[claim_named(claim)], &[subject], &Draw::default(), || {})[..] else {
        panic!("one claim, one outcome")
    };
    assert_eq!(outcome.verdict, Verdict::Rejected, "{outcome:?}");
    assert!(outcome.finding.as_ref().is_some_and(|finding| !finding.is_empty()), "{outcome:?}");
}

#[test]
fn an_ideal_source_passes_every_claim() {
    for variant in [Variant::Isotropic, Variant::Anisotropic] {
        // The listings fail by themselves, on axis-aligned planes and at the edge of the number format.
        let Robust { hash_scale, join, repairs, .. } = Robust::new(variant);
        let ideal = Robust { variant, hash: Ideal, hash_scale, join, repairs };
        for precision in Precision::ALL {
            let subject = Subject::robust("ideal", precision, ideal);
            let failed = claims_that_fail(&run_claims(claims::ALL, &[subject], &Draw::default(), || {}));
            assert!(failed.is_empty(), "{variant} {precision}: {failed:?}");
        }
    }
}

#[test]
fn without_the_cdf_thresholds_depend_on_the_lerp_factor() {
    assert_rejected_by("uniform.by_lerp_factor", |footprint| SOUND.trace(footprint).interpolated);
}

#[test]
fn one_derivative_used_twice_changes_stability() {
    assert_rejected_by("stability.translate", |footprint| {
        SOUND.threshold(&Footprint { dpdy: footprint.dpdx, ..*footprint })
    });
}

#[test]
fn both_octaves_at_one_scale_are_not_uniform_and_too_stable() {
    let same_scale = |footprint: &Footprint<f64>| {
        let found = Variant::Isotropic.two_scale(footprint, 1.0);
        let hash: f64 = Ideal.hash(&found.floor_cell);
        let interpolated = (1.0 - found.lerp_factor) * hash + found.lerp_factor * hash;
        cdf::cdf(interpolated, found.lerp_factor).max(1.0e-6)
    };
    assert_rejected_by("uniform.by_lerp_factor", same_scale);
    assert_rejected_by("stability.translate", same_scale);
}

#[test]
fn a_threshold_of_zero_is_out_of_range() {
    assert_rejected_by(
        "range",
        |footprint| if footprint.position.x > 11.0 { 0.0 } else { SOUND.threshold(footprint) },
    );
}

#[test]
fn a_gamma_curve_is_not_uniform() {
    let gamma = |footprint: &Footprint<f64>| libm::pow(SOUND.threshold(footprint), 1.1);
    assert_rejected_by("uniform.marginal", gamma);
    assert_rejected_by("uniform.coverage", gamma);
}

#[test]
fn a_hash_with_few_values_has_a_bias_on_each_plane() {
    // As the sine hash in f32: the plane is hashed into few values, each of which is mixed with z.
    assert_rejected_by("uniform.constant_z", |footprint| sound(FewValues).threshold(footprint));
}

/// Hashes x and y into 4096 values before z comes in.
#[derive(Clone, Copy)]
struct FewValues;

impl<R: Real> Hash<R> for FewValues {
    fn hash(&self, cell: &Cell<R>) -> R {
        let [x, y, _] = cell.index.into();
        let inner: R = HashKind::Mm4.hash(&Cell { index: [x, y, R::from_f64(0.0)].into(), octave: 0 });
        let index = [(inner * R::from_f64(4096.0)).floor(), R::from_f64(0.0), cell.index.into()[2]];
        HashKind::Mm4.hash(&Cell { index: index.into(), octave: 0 })
    }
}

#[test]
fn cells_that_share_a_hash_in_twos_depend_on_their_neighbours() {
    assert_rejected_by("independence.neighbours", |footprint| sound(Paired).threshold(footprint));
}

/// Drops the lowest bit of x.
#[derive(Clone, Copy)]
struct Paired;

impl<R: Real> Hash<R> for Paired {
    fn hash(&self, cell: &Cell<R>) -> R {
        let [x, y, z] = cell.index.into();
        let half = (x * R::from_f64(0.5)).floor();
        Ideal.hash(&Cell { index: [half, y, z].into(), octave: cell.octave })
    }
}

#[test]
fn the_negative_control_notices_a_join_that_needs_no_cdf() {
    // One scale and one hash: the value is uniform as it is.
    let single = HashedAlpha { variant: Variant::Single, ..SOUND };
    let subject = Subject::hashed("single", Precision::F64, single);
    let [control] =
        &run_claims(&[claim_named("uniform.without_cdf")], &[subject], &Draw::default(), || {})[..]
    else {
        panic!("one outcome")
    };
    assert_eq!(control.verdict, Verdict::Consistent);
    assert!(!control.as_expected());
}

/// The robust threshold without one of its repairs.
fn unrepaired(variant: Variant, precision: Precision, repair: Repair) -> Subject<'static> {
    let robust = Robust { repairs: Repairs::ALL.without(repair), ..Robust::new(variant) };
    Subject::robust("specimen", precision, robust)
}

#[test]
fn cells_cut_at_whole_numbers_flicker_on_dyadic_planes() {
    for variant in [Variant::Isotropic, Variant::Anisotropic] {
        assert_rejects("planes.dyadic", unrepaired(variant, Precision::F32, Repair::NestedPhase));
    }
}

#[test]
fn without_a_floor_axis_aligned_planes_divide_by_zero() {
    let subject = unrepaired(Variant::Anisotropic, Precision::F32, Repair::DerivativeFloor);
    assert_rejects("planes.axis_aligned", subject);
}

#[test]
fn leaving_out_axes_of_no_derivative_keeps_the_flicker_of_rounding() {
    // Every threshold is a number, but where the rasteriser is off by one unit the cell is as small as that unit.
    let robust = Robust {
        repairs: Repairs::ALL.without(Repair::DerivativeFloor),
        ..Robust::new(Variant::Anisotropic)
    };
    let patched = move |footprint: &Footprint<f64>| {
        let mut patched = *footprint;
        for axis in 0..3 {
            if footprint.dpdx[axis] == 0.0 && footprint.dpdy[axis] == 0.0 {
                patched.dpdx[axis] = footprint.dpdx.abs().max_element();
            }
        }
        robust.threshold(&patched).ok()
    };
    let subject = Subject::new("specimen", Precision::F64, Variant::Anisotropic, patched);
    let [outcome] =
        &run_claims(&[claim_named("planes.axis_aligned")], &[subject], &Draw::default(), || {})[..]
    else {
        panic!("one claim, one outcome")
    };
    assert_eq!(outcome.verdict, Verdict::Rejected, "{outcome:?}");
    assert_eq!(outcome.p, Some(0.0), "a matter of the share that is redrawn: {outcome:?}");
}

#[test]
fn layers_that_share_their_hash_hide_each_other() {
    assert_rejected_by("layers.parallel", |footprint| sound(WithoutZ).threshold(footprint));
}

/// Hashes x and y only.
#[derive(Clone, Copy)]
struct WithoutZ;

impl<R: Real> Hash<R> for WithoutZ {
    fn hash(&self, cell: &Cell<R>) -> R {
        let [x, y, _] = cell.index.into();
        Ideal.hash(&Cell { index: [x, y, R::from_f64(0.0)].into(), octave: cell.octave })
    }
}

#[test]
fn degenerate_inputs_need_validation_and_a_floor() {
    for precision in Precision::ALL {
        for repair in [Repair::ValidateInputs, Repair::DerivativeFloor] {
            assert_rejects("range.degenerate", unrepaired(Variant::Isotropic, precision, repair));
        }
        assert_rejects(
            "range.far_from_origin",
            unrepaired(Variant::Isotropic, precision, Repair::DerivativeFloor),
        );
    }
}

/// A robust threshold whose hash sees another cell than the one that it is given.
#[derive(Clone, Copy)]
struct Redirected(fn([f64; 3], u32) -> ([f64; 3], u32));

impl<R: Real> Hash<R> for Redirected {
    fn hash(&self, cell: &Cell<R>) -> R {
        let index: [R; 3] = cell.index.into();
        let (index, octave) = (self.0)(index.map(R::to_f64), cell.octave);
        HashKind::Mm4.hash(&Cell { index: index.map(R::from_f64).into(), octave })
    }
}

/// Tries a robust threshold whose hash sees other cells.
fn assert_rejects_redirected(claim: &str, to: fn([f64; 3], u32) -> ([f64; 3], u32)) {
    let preset = Robust::new(Variant::Isotropic);
    let Robust { variant, hash_scale, join, repairs, .. } = preset;
    let robust = Robust { hash: Redirected(to), variant, hash_scale, join, repairs };
    assert_rejects(claim, Subject::robust("specimen", Precision::F32, robust));
}

#[test]
fn truncation_for_floor_makes_one_cell_of_two_at_zero() {
    assert_rejects_redirected("independence.across_zero", |index, octave| {
        (index.map(|i| if i < 0.0 { i + 1.0 } else { i }), octave)
    });
}

#[test]
fn cells_that_are_tied_in_a_diagonal_depend_on_each_other() {
    assert_rejects_redirected("independence.diagonals", |[x, y, z], octave| {
        let is_odd = |i: f64| i.rem_euclid(2.0) == 1.0;
        if is_odd(x) && is_odd(y) { ([x - 1.0, y - 1.0, z], octave) } else { ([x, y, z], octave) }
    });
}

#[test]
fn an_octave_that_copies_one_above_is_no_new_noise() {
    assert_rejects_redirected("independence.octaves", |index, octave| {
        let is_multiple = index.iter().all(|i| i.rem_euclid(4.0) == 0.0);
        if is_multiple { (index.map(|i| i / 4.0), octave.wrapping_sub(2)) } else { (index, octave) }
    });
}

#[test]
fn without_the_octave_an_object_of_half_the_size_has_the_same_noise() {
    assert_rejects(
        "independence.octaves",
        unrepaired(Variant::Isotropic, Precision::F64, Repair::OctaveWord),
    );
}

#[test]
fn a_clamp_to_eight_bits_leaves_the_ends_of_the_range_empty() {
    let robust = Robust::new(Variant::Isotropic);
    let clamped = |low: f64, high: f64| {
        Subject::new("specimen", Precision::F64, Variant::Isotropic, move |footprint: &Footprint<f64>| {
            robust.threshold(footprint).ok().map(|threshold| threshold.clamp(low, high))
        })
    };
    assert_rejects("atoms.ends", clamped(1.0 / 255.0, 1.0));
    assert_rejects("atoms.ends", clamped(1e-9, 254.0 / 255.0));
}
