//! `stats::variance`.

use super::calibration::{assert_close, assert_uniform_p};
use hashed_alpha::stats::StatsError;
use hashed_alpha::stats::normal;
use hashed_alpha::stats::seed::{rng, uniform01};
use hashed_alpha::stats::variance::*;
use rand::Rng;

fn sample(n: usize, sigma: f64, rng: &mut impl Rng) -> Variance {
    let values: Vec<f64> = (0..n).map(|_| sigma * normal::quantile(uniform01(rng).max(1e-300))).collect();
    Variance::of(&values).unwrap()
}

/// scipy.stats: chi2 and ttest_1samp.
#[test]
fn the_statistics_match_a_reference() {
    let v = Variance::of(&[1.0, 2.0, 4.0, 8.0]).unwrap();
    assert_eq!((v.mean, v.dof), (3.75, 3));
    assert_close(v.variance, 9.583333333333334, 1e-15);
    assert_close(v.against(2.0).upper, 0.0024367052227767996, 1e-13);
    assert_close(v.against(2.0).lower, 0.9975632947772232, 1e-13);
    assert_close(v.mean_p(1.0), 0.17369950650853067, 1e-13);
}

#[test]
fn too_little_is_refused() {
    assert_eq!(Variance::of(&[1.0]), Err(StatsError::Empty));
    assert!(Variance::of(&[1.0, f64::NAN]).is_err());
}

#[test]
fn p_is_uniform_on_an_ideal_source() {
    assert_uniform_p("stats.variance.against", |rng| sample(20, 3.0, rng).against(9.0).two_sided_p());
    assert_uniform_p("stats.variance.mean_p", |rng| sample(5, 3.0, rng).mean_p(0.0));
}

/// A standard deviation a tenth too small, and one too large; a mean off by a fifth of it.
#[test]
fn broken_sources_are_rejected() {
    let mut rng = rng("stats.variance.broken", 0);
    let v = sample(4000, 0.9, &mut rng);
    assert!(v.against(1.0).lower < 1e-9 && v.against(0.81).two_sided_p() > 1e-4);
    assert!(v.mean_p(0.2) < 1e-9);
}
