//! Sound thresholds that are stored in few bits are sound.

use hashed_alpha::check::{Budget, Draw, Precision, Standing, Subject, claims, run_claims};
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::robust::Robust;
use hashed_alpha::threshold::two_scale::Variant;

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
