//! `stats::correlation`.

use super::calibration::{assert_close, assert_uniform_p};
use hashed_alpha::stats::StatsError;
use hashed_alpha::stats::correlation::*;
use hashed_alpha::stats::seed::{rng, uniform01};

/// scipy.stats.pearsonr.
#[test]
fn r_matches_a_reference() {
    let c = pearson(&[1.0, 2.0, 3.0, 4.0, 5.0], &[2.0, 1.0, 4.0, 3.0, 7.0]).unwrap();
    assert_close(c.r, 0.8241633836921339, 1e-14);
    assert_close(c.z, 2.0 * c.r, 1e-15);
}

#[test]
fn degenerate_sequences_are_refused() {
    assert_eq!(pearson(&[1.0; 5], &[1.0, 2.0, 3.0, 4.0, 5.0]), Err(StatsError::Constant));
    assert_eq!(pearson(&[1.0, 2.0], &[1.0, 2.0]), Err(StatsError::Empty));
    assert_eq!(pearson(&[1.0], &[]), Err(StatsError::LengthMismatch { left: 1, right: 0 }));
    assert_eq!(pearson(&[1.0, f64::NAN, 2.0], &[1.0, 2.0, 4.0]), Err(StatsError::Constant));
}

#[test]
fn chunks_add_up_to_the_whole() {
    let mut rng = rng("stats.correlation.chunks", 0);
    let x: Vec<f64> = (0..1000).map(|_| uniform01(&mut rng)).collect();
    let y: Vec<f64> = x.iter().map(|&x| 5.0 + 0.3 * x + uniform01(&mut rng)).collect();
    let whole = pearson(&x, &y).unwrap();
    let mut sums = Moments::default();
    sums.merge(&Moments::of(&x, &y));
    assert_eq!(sums.correlation(), Ok(whole));
    let mut sums = Moments::default();
    for (x, y) in x.chunks(300).zip(y.chunks(300)) {
        sums.merge(&Moments::of(x, y));
    }
    sums.merge(&Moments::of(&[], &[]));
    let chunked = sums.correlation().unwrap();
    assert_eq!(chunked.n, 1000);
    assert_close(chunked.r, whole.r, 1e-12);
}

#[test]
fn p_is_uniform_on_an_ideal_source() {
    assert_uniform_p("stats.correlation.pearson", |rng| {
        let x: Vec<f64> = (0..200).map(|_| uniform01(rng)).collect();
        let y: Vec<f64> = (0..200).map(|_| uniform01(rng)).collect();
        pearson(&x, &y).unwrap().p
    });
}

/// A tenth of the values is copied: correlation .1, z = 10 at 10 000 pairs.
#[test]
fn a_sequence_that_leaks_is_rejected() {
    let mut rng = rng("stats.correlation.leak", 0);
    let x: Vec<f64> = (0..10_000).map(|_| uniform01(&mut rng)).collect();
    let y: Vec<f64> =
        x.iter().map(|&x| if uniform01(&mut rng) < 0.1 { x } else { uniform01(&mut rng) }).collect();
    assert!(pearson(&x, &y).unwrap().p < 1e-9);
}

#[test]
fn pairs_are_counted_by_row_and_column() {
    let table = pair_table([(0.0, 0.9), (1.0, 0.0), (0.2, 1.0), (f64::NAN, 0.5), (0.5, 2.0)], 2);
    assert_eq!(table, [0, 2, 1, 0]);
}
