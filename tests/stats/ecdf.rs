//! `stats::ecdf`.

use super::calibration::{assert_close, assert_uniform_p};
use hashed_alpha::stats::StatsError;
use hashed_alpha::stats::ecdf::*;
use hashed_alpha::stats::seed::{rng, uniform01};

const TEN: [f64; 10] = [0.55, 0.13, 0.17, 0.97, 0.42, 0.01, 0.61, 0.78, 0.83, 0.31];

/// scipy.stats.kstest(..., method="exact").
#[test]
fn distance_takes_both_sides_of_a_step() {
    let ks = kolmogorov_smirnov(&mut TEN.clone()).unwrap();
    assert_close(ks.d, 0.13, 1e-14);
    assert_close(ks.p, 0.9874829346609387, 1e-10);
    assert_eq!((ks.n, ks.dkwm), (10, 1.0));
}

/// mpmath, 40 digits: Marsaglia-Tsang-Wang in the bulk, Birnbaum-Tingey doubled in the tail.
#[test]
fn exact_tails_are_true_tails() {
    for (n, d, p) in [
        (5, 0.3, 0.664),
        (10, 0.5, 0.00777741),
        (10, 0.9, 2.0e-10),
        (100, 0.05, 0.95321597106357248),
        (100, 0.1, 0.25269275700639007),
        (100, 0.3, 1.7719869892662894e-8),
        (1000, 0.02, 0.81089713107021213),
        (1000, 0.03, 0.32269024641329994),
        (1000, 0.05, 0.013012071309966894),
        (1000, 0.1, 3.703687096817719e-9),
        (1000, 0.3, 2.590715705736809e-80),
    ] {
        assert_close(upper_p(d, n), p, 1e-10);
    }
    assert_eq!((upper_p(0.0, 7), upper_p(1.0, 7)), (1.0, 0.0));
}

#[test]
fn the_bound_is_never_below_p() {
    for n in [1, 2, 7, 50, 1000, 5000, 1_000_000] {
        for i in 1..200 {
            let d = f64::from(i) * 0.03 / (n as f64).sqrt();
            if d < 1.0 {
                let bound = (2.0 * libm::exp(-2.0 * n as f64 * d * d)).min(1.0);
                assert!(upper_p(d, n) <= bound * (1.0 + 1e-9), "n {n} d {d}: {} {bound}", upper_p(d, n));
            }
        }
    }
    assert_close(2.0 * libm::exp(-2.0 * 1000.0 * dkwm_distance(1000, 1e-9).powi(2)), 1e-9, 1e-12);
}

#[test]
fn ties_count_once_each() {
    let ks = kolmogorov_smirnov(&mut [0.5, 0.5, 0.5, 0.5]).unwrap();
    assert_eq!(ks.d, 0.5);
    assert_eq!(kolmogorov_smirnov(&mut [0.0, 0.0]).unwrap().d, 1.0);
}

#[test]
fn what_is_not_in_the_interval_is_refused() {
    assert_eq!(kolmogorov_smirnov(&mut []), Err(StatsError::Empty));
    let error = kolmogorov_smirnov(&mut [0.5, 1.5]);
    assert_eq!(error, Err(StatsError::NotAProbability { value: 1.5 }));
    assert!(kolmogorov_smirnov(&mut [0.5, f64::NAN]).is_err());
}

#[test]
fn p_is_uniform_on_an_ideal_source() {
    for (name, n) in [("stats.ecdf.exact", 60), ("stats.ecdf.expansion", 2000)] {
        assert_uniform_p(name, |rng| {
            let mut values: Vec<f64> = (0..n).map(|_| uniform01(rng)).collect();
            kolmogorov_smirnov(&mut values).unwrap().p
        });
    }
}

/// The square root of a uniform, diluted to a distance of .025; and the middle 97 % of the interval.
#[test]
fn broken_sources_are_rejected() {
    let mut rng = rng("stats.ecdf.broken", 0);
    let mut diluted: Vec<f64> = (0..50_000)
        .map(|_| if uniform01(&mut rng) < 0.1 { uniform01(&mut rng).sqrt() } else { uniform01(&mut rng) })
        .collect();
    assert!(kolmogorov_smirnov(&mut diluted).unwrap().p < 1e-9);
    let mut narrow: Vec<f64> = (0..100_000).map(|_| 0.015 + 0.97 * uniform01(&mut rng)).collect();
    assert!(kolmogorov_smirnov(&mut narrow).unwrap().p < 1e-9);
}
