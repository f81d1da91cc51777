//! `stats::two_sample`.

use super::calibration::{assert_close, assert_uniform_p};
use hashed_alpha::stats::StatsError;
use hashed_alpha::stats::seed::{rng, uniform01};
use hashed_alpha::stats::two_sample::*;

/// Every order in which the samples can merge, counted.
#[test]
fn small_samples_are_enumerated() {
    for (m, n) in [(4, 4), (5, 3), (6, 4), (1, 7), (7, 5)] {
        let distance = |order: u32| {
            let (mut i, mut j, mut largest) = (0_u64, 0_u64, 0);
            for step in 0..m + n {
                if order >> step & 1 == 1 {
                    i += 1
                } else {
                    j += 1
                }
                largest = largest.max((i * n).abs_diff(j * m));
            }
            largest
        };
        let orders = || (0..1_u32 << (m + n)).filter(|order| u64::from(order.count_ones()) == m);
        for k in 1..=m * n {
            let far = orders().filter(|&order| distance(order) >= k).count();
            let p = far as f64 / orders().count() as f64;
            assert_close(upper_p(k, [m, n]), p, 1e-13);
            assert_close(upper_p(k, [n, m]), p, 1e-13);
        }
    }
}

/// Only two of all merges separate the samples: p = 2 m! n! / (m + n)!.
#[test]
fn tails_are_true_tails() {
    assert_close(upper_p(400 * 500, [400, 500]), 2.3140701737176122e-267, 1e-12);
    let (mut low, mut high): (Vec<f64>, Vec<f64>) = (0..900).map(f64::from).partition(|&x| x < 400.0);
    let ks = kolmogorov_smirnov(&mut high, &mut low).unwrap();
    assert_eq!((ks.d, ks.n, ks.is_exact), (1.0, [500, 400], true));
    assert_eq!(ks.p, upper_p(400 * 500, [500, 400]));
}

#[test]
fn ties_count_once_each() {
    let ks =
        |left: &[f64], right: &[f64]| kolmogorov_smirnov(&mut left.to_vec(), &mut right.to_vec()).unwrap().d;
    assert_eq!(ks(&[1.0, 1.0, 2.0], &[2.0, 1.0, 1.0]), 0.0);
    assert_eq!(ks(&[0.0, -0.0], &[-0.0]), 0.0);
    assert_eq!(ks(&[1.0, 1.0, 2.0, 3.0], &[1.0, 2.0]), 0.25);
    assert_eq!(kolmogorov_smirnov(&mut [1.0], &mut [1.0]).unwrap().p, 1.0);
}

#[test]
fn what_has_no_order_is_refused() {
    assert_eq!(kolmogorov_smirnov(&mut [], &mut [1.0]), Err(StatsError::Empty));
    assert!(kolmogorov_smirnov(&mut [1.0], &mut [f64::NAN]).is_err());
    let error = kolmogorov_smirnov(&mut [1.0], &mut [f64::INFINITY]);
    assert_eq!(error, Err(StatsError::NotFinite { value: f64::INFINITY }));
}

#[test]
fn p_is_uniform_on_an_ideal_source() {
    assert_uniform_p("stats.two_sample", |rng| {
        let mut sample = |n| (0..n).map(|_| uniform01(rng)).collect::<Vec<_>>();
        kolmogorov_smirnov(&mut sample(300), &mut sample(211)).unwrap().p
    });
}

/// A quarter of one sample is squared: a distance of .06.
#[test]
fn samples_of_different_laws_are_rejected() {
    let mut rng = rng("stats.two_sample.broken", 0);
    let mut left: Vec<f64> = (0..40_000).map(|_| uniform01(&mut rng)).collect();
    let mut right: Vec<f64> =
        (0..30_000).map(|i| uniform01(&mut rng).powi(if i % 4 == 0 { 2 } else { 1 })).collect();
    assert!(kolmogorov_smirnov(&mut left, &mut right).unwrap().p < 1e-9);
}
