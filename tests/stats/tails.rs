//! The tail below 1e-3: laws that are approximations, at the levels at which claims are judged.
//!
//! Importance sampling: the source is tilted until the rare is common, and every replica counts by how much less likely the
//! ideal source makes it.

use super::calibration::ideal;
use hashed_alpha::stats::seed::uniform01;
use hashed_alpha::stats::{chi_square, correlation, poisson_binomial};

/// Levels at which the true probability of a smaller p-value is measured.
const LEVELS: [f64; 3] = [1e-4, 1e-6, 1e-9];

/// The true probability of a p-value up to each level, from pairs of a p-value and the logarithm of its weight, with its
/// standard error.
fn probabilities(replicas: &[[f64; 2]]) -> [[f64; 2]; 3] {
    let n = replicas.len() as f64;
    LEVELS.map(|level| {
        let weights = || replicas.iter().filter(|[p, _]| *p <= level).map(|[_, log]| libm::exp(*log));
        let mean = weights().sum::<f64>() / n;
        let square = weights().map(|weight| weight * weight).sum::<f64>() / n;
        [mean, ((square - mean * mean) / n).sqrt()]
    })
}

/// Asserts that no level is exceeded by more than a factor, but for four standard errors, and that the sampling saw it.
fn assert_tails(name: &str, replicas: &[[f64; 2]], most: f64) {
    for (level, [p, error]) in LEVELS.into_iter().zip(probabilities(replicas)) {
        assert!(p - 4.0 * error < most * level, "{name}: {p:e} +- {error:e} at {level:e}");
        assert!(error < 0.3 * p.max(0.01 * level), "{name}: {p:e} +- {error:e} at {level:e} says nothing");
    }
}

/// Uneven counts: the probabilities of the bins are drawn from Dirichlet's law, under which counts vary twice as much.
#[test]
fn chi_square_of_the_smallest_group() {
    const BINS: usize = 64;
    const DRAWS: usize = 64 * BINS;
    const SHAPE: usize = 50;
    let mut rng = ideal("stats.tails.chi_square");
    let log_gamma = |x: f64| libm::lgamma(x);
    let all = (BINS * SHAPE) as f64;
    let replicas: Vec<[f64; 2]> = (0..4000)
        .map(|_| {
            let mut cumulated = [0.0; BINS];
            let mut sum = 0.0;
            for edge in &mut cumulated {
                let product: f64 = (0..SHAPE).map(|_| 1.0 - uniform01(&mut rng)).product();
                sum -= libm::log(product);
                *edge = sum;
            }
            let mut counts = [0_u64; BINS];
            for _ in 0..DRAWS {
                let at = uniform01(&mut rng) * sum;
                counts[cumulated.partition_point(|&edge| edge <= at).min(BINS - 1)] += 1;
            }
            let shape = SHAPE as f64;
            let of_bins: f64 = counts.iter().map(|&c| log_gamma(c as f64 + shape) - log_gamma(shape)).sum();
            let log_proposal = log_gamma(all) - log_gamma(all + DRAWS as f64) + of_bins;
            let log_ideal = -(DRAWS as f64) * libm::log(BINS as f64);
            [chi_square::uniform(&counts).unwrap().p, log_ideal - log_proposal]
        })
        .collect();
    assert_tails("chi-square", &replicas, 1.5);
}

/// Rare events: the odds of each are multiplied by one number.
#[test]
fn counts_of_rare_events() {
    let mut rng = ideal("stats.tails.events");
    let events: Vec<f64> = (0..8192).map(|i| 0.01 + 0.02 * f64::from(i) / 8192.0).collect();
    let mean: f64 = events.iter().sum();
    let variance: f64 = events.iter().map(|p| p * (1.0 - p)).sum();
    for z in [-5.5, 5.5] {
        let tilt = z / variance.sqrt();
        let grown = libm::exp(tilt);
        let log_moment: f64 = events.iter().map(|p| libm::log1p(p * (grown - 1.0))).sum();
        let tilted: Vec<f64> = events.iter().map(|p| p * grown / (1.0 + p * (grown - 1.0))).collect();
        let replicas: Vec<[f64; 2]> = (0..4000)
            .map(|_| {
                let count = tilted.iter().filter(|&&p| uniform01(&mut rng) < p).count() as u64;
                let test = poisson_binomial::sum_of_events(count, mean, variance);
                // One side at a time, of which each has half of the level.
                let p = if test.z * z > 0.0 { 0.5 * test.p } else { 1.0 };
                [p, log_moment - tilt * count as f64]
            })
            .collect();
        for (level, [p, error]) in LEVELS.into_iter().zip(probabilities(&replicas)) {
            assert!(p - 4.0 * error < level, "z {z}: {p:e} +- {error:e} at {level:e}");
        }
    }
}

/// Correlated pairs of uniform values: their density is tilted by the exponential of their product.
#[test]
fn correlation_of_uniform_values() {
    const PAIRS: usize = 4096;
    let mut rng = ideal("stats.tails.correlation");
    let tilt = 6.0 / (PAIRS as f64).sqrt();
    // The integral over v of exp(12 tilt u v) for v in (-1/2, 1/2).
    let inner = |u: f64| {
        let t = 6.0 * tilt * u;
        if t.abs() < 1e-6 { 1.0 } else { libm::sinh(t) / t }
    };
    let steps = 2000;
    let moment: f64 = (0..steps).map(|i| inner((f64::from(i) + 0.5) / f64::from(steps) - 0.5)).sum::<f64>()
        / f64::from(steps);
    let pair = |rng: &mut dyn FnMut() -> f64| loop {
        let u = rng() - 0.5;
        if rng() * inner(0.5) > inner(u) {
            continue;
        }
        // The inverse of the distribution function of exp(t v).
        let t = 12.0 * tilt * u;
        let at = rng();
        let v = if t.abs() < 1e-9 { at - 0.5 } else { libm::log1p(at * libm::expm1(t)) / t - 0.5 };
        return [u, v];
    };
    let mut source = || uniform01(&mut rng);
    let replicas: Vec<[f64; 2]> = (0..3000)
        .map(|_| {
            let pairs: Vec<[f64; 2]> = (0..PAIRS).map(|_| pair(&mut source)).collect();
            let column = |which: usize| pairs.iter().map(|pair| pair[which] + 0.5).collect::<Vec<f64>>();
            let found = correlation::pearson(&column(0), &column(1)).unwrap();
            let sum: f64 = pairs.iter().map(|[u, v]| 12.0 * u * v).sum();
            let p = if found.r > 0.0 { 0.5 * found.p } else { 1.0 };
            [p, PAIRS as f64 * libm::log(moment) - tilt * sum]
        })
        .collect();
    assert_tails("correlation", &replicas, 1.5);
}
