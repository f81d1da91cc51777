//! `stats::fisher_g`.

use super::calibration::{assert_close, assert_uniform_p};
use hashed_alpha::stats::StatsError;
use hashed_alpha::stats::fisher_g::*;
use hashed_alpha::stats::seed::{rng, uniform01};

/// mpmath, Fisher's sum with up to 400 digits.
#[test]
fn tails_are_true_tails() {
    for (n, g, p) in [
        (20, 0.12, 0.94724952232803009),
        (20, 0.2, 0.27668387691888633),
        (100, 0.03, 0.99921695177393173),
        (100, 0.05, 0.49280026032809685),
        (32_640, 2.5e-4, 0.9999185029783871),
        (32_640, 3e-4, 0.83915196911371171),
        (32_640, 4e-4, 0.067249719583950124),
        (32_640, 1e-3, 2.1464479316914227e-10),
    ] {
        assert_close(upper_p(g, n), p, 1e-10);
    }
    assert_eq!((upper_p(0.5, 2), upper_p(0.75, 2), upper_p(1.0, 2), upper_p(1.0, 1)), (1.0, 0.5, 0.0, 1.0));
}

#[test]
fn p_is_uniform_on_an_ideal_source() {
    for n in [10, 500] {
        assert_uniform_p(&format!("stats.fisher_g.{n}"), |rng| {
            let ordinates: Vec<f64> = (0..n).map(|_| -libm::log1p(-uniform01(rng))).collect();
            fisher_g(&ordinates).unwrap().p
        });
    }
}

/// One ordinate of 10 000 has 40 times the mean: the distribution does not show it, g does.
#[test]
fn a_tone_is_rejected_and_found() {
    let mut rng = rng("stats.fisher_g.tone", 0);
    let mut ordinates: Vec<f64> = (0..10_000).map(|_| -libm::log1p(-uniform01(&mut rng))).collect();
    ordinates[1234] += 40.0;
    let found = fisher_g(&ordinates).unwrap();
    assert!(found.p < 1e-9 && found.at == 1234);
    assert!(hashed_alpha::stats::ecdf::kolmogorov_smirnov_exponential(&mut ordinates).unwrap().p > 1e-4);
}

#[test]
fn what_is_no_spectrum_is_refused() {
    assert_eq!(fisher_g(&[]), Err(StatsError::Empty));
    assert_eq!(fisher_g(&[0.0, 0.0]), Err(StatsError::Constant));
    assert!(fisher_g(&[1.0, -1.0]).is_err() && fisher_g(&[f64::NAN]).is_err());
}
