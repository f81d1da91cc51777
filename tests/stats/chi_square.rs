//! `stats::chi_square`.

use super::calibration::{assert_close, assert_uniform_p};
use hashed_alpha::stats::StatsError;
use hashed_alpha::stats::chi_square::*;
use hashed_alpha::stats::correlation::pair_table;
use hashed_alpha::stats::histogram::Histogram;
use hashed_alpha::stats::seed::{rng, uniform01};
use rand::Rng;

fn histogram(bins: usize, n: u32, rng: &mut impl Rng) -> Histogram {
    let mut h = Histogram::new(bins);
    h.extend((0..n).map(|_| uniform01(rng)));
    h
}

/// mpmath, 50 digits.
#[test]
fn upper_tails_are_true_tails() {
    for (x, dof, p) in [
        (50.0, 1, 1.5374597944280349e-12),
        (1400.0, 1, 2.1010145162642175e-306),
        (60.0, 63, 0.58392733052627716),
        (1000.0, 63, 1.0740610347992447e-168),
        (1600.0, 63, 9.0767071550919754e-293),
        (300.0, 100, 7.4121008573228768e-22),
        (500.0, 100, 1.7201210053695375e-54),
        (400.0, 255, 1.660002524412452e-8),
        (600.0, 255, 7.531973752278672e-30),
        (1500.0, 1023, 1.028636388160568e-20),
        (5000.0, 4095, 4.2528841109562227e-21),
        (66_000.0, 65_535, 0.099707849240150684),
        (70_000.0, 65_535, 8.0436662125921853e-34),
        (80_000.0, 65_535, 1.5008522011270712e-305),
        (1_010_000.0, 1_000_000, 9.0685288232620769e-13),
    ] {
        assert_close(ChiSquare::new(x, dof, 1).p, p, if dof < 65_536 { 1e-10 } else { 1e-9 });
    }
}

/// mpmath, 50 digits.
#[test]
fn lower_tails_are_true_tails() {
    for (x, dof, p) in [
        (0.001, 1, 0.025227120630039612),
        (20.0, 63, 4.4508910800326678e-8),
        (3900.0, 4095, 0.014535684092396682),
        (990_000.0, 1_000_000, 6.5001711800858377e-13),
    ] {
        assert_close(ChiSquare::new(x, dof, 1).lower_p(), p, if dof < 65_536 { 1e-10 } else { 1e-9 });
    }
}

/// scipy.stats: chisquare, chi2_contingency(correction=False).
#[test]
fn statistics_match_a_reference() {
    let u = uniform(&[12, 8, 9, 11]).unwrap();
    assert_eq!((u.statistic, u.dof, u.n, u.effect), (1.0, 3, 40, 0.0));
    assert_close(u.p, 0.8012519569012009, 1e-12);
    let a = against(&[18, 22, 31, 29], &[0.25, 0.2, 0.25, 0.3]).unwrap();
    assert_close(a.statistic, 3.6333333333333333, 1e-12);
    assert_close(a.p, 0.30387649202744216, 1e-12);
    let i = independence(&[10, 20, 30, 6, 9, 17, 8, 7, 13], 3).unwrap();
    assert_eq!((i.dof, i.n), (4, 120));
    assert_close(i.statistic, 2.0138888888888893, 1e-12);
    assert_close(i.p, 0.7332041844639471, 1e-12);
    let t = two_sample(&[12, 18, 25, 30], &[20, 22, 18, 25]).unwrap();
    assert_close(t.statistic, 3.994080338266385, 1e-12);
    assert_close(t.p, 0.2621040563640981, 1e-12);
    assert_close(t.effect, (t.statistic - 3.0) / 170.0, 1e-12);
}

#[test]
fn neighbours_are_pooled_until_five_are_expected() {
    // 40 observations: expected 2, 2, 2, 14, 16, 4 -> 6 (the first three), 14, 20 (the last two).
    let q = [0.05, 0.05, 0.05, 0.35, 0.4, 0.1];
    let pooled = against(&[1, 3, 4, 12, 15, 5], &q).unwrap();
    assert_eq!(pooled.dof, 2);
    assert_close(pooled.statistic, 4.0 / 6.0 + 4.0 / 14.0, 1e-12);
    // The same law in either sample, so pooling looks at the smaller one.
    assert_eq!(two_sample(&[1, 2, 3, 4], &[100, 200, 300, 400]), Err(StatsError::TooFewBins { bins: 1 }));
}

#[test]
fn empty_rows_and_columns_cost_no_degrees_of_freedom() {
    let full = independence(&[10, 20, 30, 25], 2).unwrap();
    assert_eq!(independence(&[10, 0, 20, 0, 0, 0, 30, 0, 25], 3).unwrap(), full);
}

#[test]
fn data_that_cannot_be_judged_is_refused() {
    assert_eq!(uniform(&[]), Err(StatsError::Empty));
    assert_eq!(uniform(&[0, 0]), Err(StatsError::Empty));
    assert_eq!(uniform(&[4, 5]), Err(StatsError::TooFewBins { bins: 1 }));
    assert_eq!(against(&[9], &[]), Err(StatsError::LengthMismatch { left: 1, right: 0 }));
    assert_eq!(against(&[9, 9], &[1.5, -0.5]), Err(StatsError::NotAProbability { value: 1.5 }));
    assert_eq!(against(&[9, 9], &[0.5, 0.25]), Err(StatsError::NotNormalized { sum: 0.75 }));
    assert_eq!(independence(&[1, 2, 3], 2), Err(StatsError::LengthMismatch { left: 3, right: 2 }));
    assert_eq!(independence(&[7, 0, 8, 0], 2), Err(StatsError::TooFewBins { bins: 1 }));
    assert_eq!(two_sample(&[9, 9], &[0, 0]), Err(StatsError::Empty));
}

#[test]
fn the_impossible_has_p_zero() {
    let c = against(&[50, 50, 1], &[0.5, 0.5, 0.0]).unwrap();
    assert_eq!((c.statistic, c.p, c.lower_p()), (f64::INFINITY, 0.0, 1.0));
}

#[test]
fn an_empty_bin_that_must_be_empty_says_nothing() {
    let with = against(&[30, 50, 0, 20], &[0.3, 0.5, 0.0, 0.2]).unwrap();
    assert_eq!((with.statistic, with.p), (0.0, 1.0));
}

#[test]
fn p_is_uniform_on_an_ideal_source() {
    assert_uniform_p("stats.chi_square.uniform", |rng| uniform(histogram(16, 2000, rng).counts()).unwrap().p);
    assert_uniform_p("stats.chi_square.lower_p", |rng| {
        uniform(histogram(16, 2000, rng).counts()).unwrap().lower_p()
    });
    // The larger of two uniforms has density 2x.
    let triangle: Vec<f64> = (0..16).map(|i| f64::from(2 * i + 1) / 256.0).collect();
    assert_uniform_p("stats.chi_square.against", |rng| {
        let mut h = Histogram::new(16);
        h.extend((0..2000).map(|_| uniform01(rng).max(uniform01(rng))));
        against(h.counts(), &triangle).unwrap().p
    });
    assert_uniform_p("stats.chi_square.independence", |rng| {
        let table = pair_table((0..2000).map(|_| (uniform01(rng), uniform01(rng).max(uniform01(rng)))), 5);
        independence(&table, 5).unwrap().p
    });
    assert_uniform_p("stats.chi_square.two_sample", |rng| {
        let (left, right) = (histogram(16, 1000, rng), histogram(16, 3000, rng));
        two_sample(left.counts(), right.counts()).unwrap().p
    });
}

/// The square of a uniform has density 1/(2 sqrt x); a serial leak of one tenth; two laws.
#[test]
fn broken_sources_are_rejected() {
    let mut rng = rng("stats.chi_square.broken", 0);
    let ideal = histogram(16, 5000, &mut rng);
    let mut bent = Histogram::new(16);
    bent.extend((0..5000).map(|_| libm::pow(uniform01(&mut rng), 1.2)));
    assert!(uniform(bent.counts()).unwrap().p < 1e-9);
    assert!(two_sample(ideal.counts(), bent.counts()).unwrap().p < 1e-6);
    let triangle: Vec<f64> = (0..16).map(|i| f64::from(2 * i + 1) / 256.0).collect();
    assert!(against(ideal.counts(), &triangle).unwrap().p < 1e-200);
    let leak = pair_table(
        (0..20_000).map(|_| {
            let u = uniform01(&mut rng);
            (u, if uniform01(&mut rng) < 0.1 { u } else { uniform01(&mut rng) })
        }),
        8,
    );
    assert!(independence(&leak, 8).unwrap().p < 1e-9);
}

/// .6 and .4 for a half each: w² = 2 (.1)²/.5 = .04.
#[test]
fn the_effect_estimates_w_squared() {
    let c = against(&[600_000, 400_000], &[0.5, 0.5]).unwrap();
    assert_close(c.effect, 0.04, 1e-4);
}

/// A perfectly stratified sample.
#[test]
fn counts_that_are_too_even_have_a_tiny_lower_tail() {
    let c = uniform(&[1000; 64]).unwrap();
    assert_eq!((c.p, c.effect), (1.0, 0.0));
    assert!(c.lower_p() < 1e-100);
}
