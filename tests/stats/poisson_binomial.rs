//! `stats::poisson_binomial`.

use super::calibration::assert_uniform_p;
use hashed_alpha::stats::binomial;
use hashed_alpha::stats::poisson_binomial::*;
use hashed_alpha::stats::seed::{rng, uniform01};

#[test]
fn p_is_uniform_on_an_ideal_source() {
    // Probabilities i/20000: mean about 9999.5, variance about 3333.
    let (mean, variance) =
        (0..20_000).map(|i| f64::from(i) / 20_000.0).fold((0.0, 0.0), |(m, v), p| (m + p, v + p * (1.0 - p)));
    assert_uniform_p("stats.poisson_binomial", |rng| {
        let count = (0..20_000).filter(|&i| uniform01(rng) < f64::from(i) / 20_000.0).count();
        sum_of_events(count as u64, mean, variance).p
    });
}

/// Events of equal probability have an exact law to compare with.
#[test]
fn p_is_near_the_exact_one_or_above_it() {
    for (n, q) in [(20_u64, 0.5), (1000, 0.3), (1000, 0.001), (100_000, 0.01), (1_000_000, 0.4)] {
        let (mean, variance) = (n as f64 * q, n as f64 * q * (1.0 - q));
        for step in 0..40 {
            let count = (mean + f64::from(step - 20) / 2.5 * variance.sqrt()).round();
            if count < 0.0 || count > n as f64 {
                continue;
            }
            let exact = binomial::two_sided_p(count as u64, n, q);
            let ours = sum_of_events(count as u64, mean, variance);
            if ours.is_bound {
                assert!(ours.p >= exact * (1.0 - 1e-9), "n {n} q {q} count {count}: {} < {exact}", ours.p);
            } else {
                // The skewness moves the middle, too.
                let slack = (ours.z.abs().powi(3) / 6.0 + 0.5) / variance.sqrt();
                assert!(
                    libm::log(ours.p / exact).abs() < slack,
                    "n {n} q {q} count {count}: {} {exact}",
                    ours.p
                );
            }
        }
    }
}

/// Events of probabilities (i/1000)², whose law is convolved.
#[test]
fn unequal_events_keep_to_the_exact_law() {
    let probabilities = (0..1000).map(|i| (f64::from(i) / 1000.0).powi(2));
    let mut law = vec![1.0];
    for q in probabilities.clone() {
        law.push(0.0);
        for count in (0..law.len()).rev() {
            law[count] = law[count] * (1.0 - q) + if count > 0 { law[count - 1] * q } else { 0.0 };
        }
    }
    let mean: f64 = probabilities.clone().sum();
    let variance: f64 = probabilities.map(|q| q * (1.0 - q)).sum();
    for observed in 290..=380 {
        let tails = [&law[..=observed], &law[observed..]].map(|tail| tail.iter().sum::<f64>());
        let exact = (2.0 * tails[0].min(tails[1])).min(1.0);
        let ours = sum_of_events(observed as u64, mean, variance);
        let slack = (ours.z.abs().powi(3) / 6.0 + 0.5) / variance.sqrt();
        let is_kept = if ours.is_bound { ours.p >= exact } else { libm::log(ours.p / exact).abs() < slack };
        assert!(is_kept, "{observed}: {} {exact}", ours.p);
    }
}

#[test]
fn certain_events_leave_no_choice() {
    assert_eq!(sum_of_events(5, 5.000_000_1, 0.0).p, 1.0);
    assert_eq!(sum_of_events(4, 5.0, 0.0), PoissonBinomial { z: f64::NEG_INFINITY, p: 0.0, is_bound: true });
}

/// All probabilities are one hundredth too high.
#[test]
fn a_biased_source_is_rejected() {
    let mut rng = rng("stats.poisson_binomial.biased", 0);
    let (mut count, mut mean, mut variance) = (0, 0.0, 0.0);
    for _ in 0..200_000 {
        let p = 0.9 * uniform01(&mut rng);
        mean += p;
        variance += p * (1.0 - p);
        count += u64::from(uniform01(&mut rng) < p + 0.01);
    }
    assert!(sum_of_events(count, mean, variance).p < 1e-9);
}
