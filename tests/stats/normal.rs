//! `stats::normal`.

use super::calibration::{assert_close, assert_uniform_p};
use hashed_alpha::stats::normal::*;
use hashed_alpha::stats::seed::uniform01;

/// mpmath, 50 digits.
#[test]
fn tails_are_true_tails() {
    for (z, p) in [
        (1.0, 0.317310507862914103),
        (3.0, 0.00269979606326018905),
        (6.0, 1.97317529007539628e-9),
        (9.0, 2.2571768119076813e-19),
        (20.0, 5.50724823721246739e-89),
        (37.0, 1.14511424450491536e-299),
    ] {
        assert_close(two_sided_p(z), p, 1e-13);
        assert_close(two_sided_p(-z), p, 1e-13);
        assert_close(upper_p(z), p / 2.0, 1e-13);
        assert_close(upper_p(-z), 1.0 - p / 2.0, 1e-15);
    }
}

/// mpmath, 50 digits.
#[test]
fn quantiles_reach_deep() {
    assert_eq!(quantile(0.5), 0.0);
    for (p, z) in [
        (0.3, -0.524400512708040784),
        (0.999, 3.09023230616781354),
        (1e-9, -5.99780701500768687),
        (1e-100, -21.2734535609653243),
        (1e-300, -37.0470962993611992),
    ] {
        assert_close(quantile(p), z, 1e-14);
    }
    assert_eq!((quantile(0.0), quantile(1.0)), (f64::NEG_INFINITY, f64::INFINITY));
}

/// The sum of 64 uniforms: mean 32, variance 64/12, close enough to normal for a thousand replicas.
#[test]
fn p_is_uniform_on_an_ideal_source() {
    let score =
        |rng: &mut _| ((0..64).map(|_| uniform01(rng)).sum::<f64>() - 32.0) / (64.0_f64 / 12.0).sqrt();
    assert_uniform_p("stats.normal.two_sided_p", |rng| two_sided_p(score(rng)));
    assert_uniform_p("stats.normal.upper_p", |rng| upper_p(score(rng)));
}

#[test]
fn a_shifted_mean_is_rejected() {
    assert!(two_sided_p((0.51 - 0.5) * (12.0 * 1e6_f64).sqrt()) < 1e-200);
}
