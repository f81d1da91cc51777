//! `stats::multiplicity`.

use super::calibration::assert_close;
use hashed_alpha::stats::multiplicity::*;
use hashed_alpha::stats::seed::{rng, uniform01};

/// R: p.adjust(c(.01, .04, .03, .005, .5), "holm").
#[test]
fn adjusted_values_match_the_definition() {
    let p = [0.01, 0.04, 0.03, 0.005, 0.5];
    for (actual, expected) in holm(&p).into_iter().zip([0.04, 0.09, 0.09, 0.025, 0.5]) {
        assert_close(actual, expected, 1e-14);
    }
    assert!(holm(&[]).is_empty());
    assert_eq!(holm(&[0.9, 0.8]), [1.0, 1.0]);
    assert_eq!(holm(&[1e-300; 2]), [2e-300; 2]);
}

/// 2000 families of 20 true hypotheses at level .05: 100 expected, 4.9 standard deviations allowed.
#[test]
fn holm_keeps_the_family_wise_error_rate() {
    let mut rng = rng("stats.multiplicity.holm", 0);
    let false_alarms = (0..2000)
        .filter(|_| {
            let p: Vec<f64> = (0..20).map(|_| uniform01(&mut rng)).collect();
            holm(&p).iter().any(|&p| p <= 0.05)
        })
        .count();
    assert!((52..148).contains(&false_alarms), "{false_alarms}");
}

#[test]
#[should_panic(expected = "not a p-value")]
fn nan_is_refused() {
    let _ = holm(&[0.5, f64::NAN]);
}
