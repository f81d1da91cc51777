//! `stats::gamma_sum`.

use super::calibration::{assert_close, assert_uniform_p};
use hashed_alpha::stats::gamma_sum::*;
use hashed_alpha::stats::seed::uniform01;
use hashed_alpha::stats::{beta, binomial};

fn sum(terms: &[[f64; 2]]) -> GammaSum {
    GammaSum::new(terms.iter().map(|&[weight, shape]| Term { weight, shape }).collect())
}

/// One gamma value: the arrivals of a Poisson process.
#[test]
fn equal_weights_are_a_gamma_law() {
    for shape in [50_u64, 704, 5000] {
        let law = sum(&[[0.25, 0.5 * shape as f64], [0.25, 0.5 * shape as f64]]);
        for deviations in [-10.0, -6.5, -2.0, -0.5, 0.0, 1e-5, 0.5, 2.0, 6.5, 10.0, 25.0] {
            let at = shape as f64 + deviations * (shape as f64).sqrt();
            if at <= 0.0 {
                continue;
            }
            let tails = law.tails(0.25 * (at - shape as f64));
            let exact = [binomial::poisson_upper_p(shape, at), binomial::poisson_lower_p(shape - 1, at)];
            assert_close(tails.lower, exact[0], 1e-3);
            assert_close(tails.upper, exact[1], 1e-3);
        }
    }
}

/// The difference of two is above 0 where their ratio is above 1: Fisher's F.
#[test]
fn weights_of_both_signs_are_fishers_law() {
    let [above, below] = [60_u64, 200];
    for ratio in [0.3, 0.6, 0.9, 1.0, 1.2, 2.0, 3.5] {
        let law = sum(&[[1.0 / above as f64, above as f64], [-ratio / below as f64, below as f64]]);
        let tails = law.tails(ratio - 1.0);
        let exact = beta::f_tails(ratio, [2 * above, 2 * below]);
        assert_close(tails.lower, exact.lower, 1e-3);
        assert_close(tails.upper, exact.upper, 1e-3);
    }
}

#[test]
fn what_is_exceeded_has_its_probability() {
    let mixed = sum(&[[1.0, 40.0], [-0.5, 90.0], [0.1, 3.5]]);
    let positive = sum(&[[1.0, 40.0], [0.5, 90.0]]);
    for law in [mixed, positive] {
        for p in [0.4, 1e-3, 1e-9, 1e-12] {
            assert_close(law.tails(law.exceeded(p, true)).upper, p, 1e-5);
            assert_close(law.tails(law.exceeded(p, false)).lower, p, 1e-5);
        }
    }
    let positive = sum(&[[1.0, 40.0]]);
    assert_eq!(positive.tails(-40.0).lower, 0.0);
    assert_eq!(positive.tails(-41.0).upper, 1.0);
}

#[test]
fn p_is_uniform_on_an_ideal_source() {
    let weights: Vec<f64> = (0..120).map(|i| f64::from(i % 11) - 3.5).collect();
    let law = GammaSum::new(weights.iter().map(|&weight| Term { weight, shape: 1.0 }).collect());
    assert_uniform_p("stats.gamma_sum", |rng| {
        let deviation: f64 =
            weights.iter().map(|weight| weight * (-libm::log1p(-uniform01(rng)) - 1.0)).sum();
        law.tails(deviation).two_sided_p()
    });
}
