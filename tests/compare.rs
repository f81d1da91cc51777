//! Two subjects are told apart no further than they differ.

use hashed_alpha::check::{Agreement, Draw, Subject, compare, subject::Precision};
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::robust::Robust;
use hashed_alpha::threshold::two_scale::Variant;

fn isotropic(threshold: impl Fn(&Footprint<f64>) -> f64 + Send + Sync + 'static) -> Subject<'static> {
    Subject::new("mine", Precision::F64, Variant::Isotropic, threshold)
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
