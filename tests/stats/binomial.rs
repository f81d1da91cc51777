//! `stats::binomial`.

use super::calibration::{assert_close, assert_uniform_p};
use hashed_alpha::stats::binomial::*;
use hashed_alpha::stats::seed::uniform01;

/// mpmath, 40 digits, at the f64 next to the probability given.
#[test]
fn binomial_tails_are_true_tails() {
    for (k, n, q, p) in [
        (7, 10, 0.5, 0.171875),
        (60, 100, 0.5, 0.028443966820490396),
        (100, 100, 0.25, 6.2230152778611417e-61),
        (5300, 10_000, 0.5, 1.0380168479603624e-9),
        (30, 1_000_000, 1e-6, 1.4324990305860825e-33),
        (502_500, 1_000_000, 0.5, 2.881270818870302e-7),
        (510_000, 1_000_000, 0.5, 2.7721816438496123e-89),
    ] {
        assert_close(upper_p(k, n, q), p, 1e-10);
        assert_close(lower_p(k - 1, n, q), 1.0 - p, 1e-13);
    }
    for (k, n, q, p) in [
        (2, 10, 0.5, 0.0546875),
        (4700, 10_000, 0.5, 1.0380168479603624e-9),
        (497_000, 1_000_000, 0.5, 9.9257488196151038e-10),
        (350, 1_000_000, 4.2e-4, 0.0002467958435883717),
        (0, 1_000_000, 4.2e-5, 5.7444532794753157e-19),
    ] {
        assert_close(lower_p(k, n, q), p, 1e-10);
        assert_close(two_sided_p(k, n, q), 2.0 * p, 1e-10);
    }
}

/// mpmath, 40 digits.
#[test]
fn poisson_tails_are_true_tails() {
    for (k, mean, p) in [
        (5, 2.5, 0.10882198108584876),
        (30, 1.0, 1.4330814167190133e-33),
        (100, 64.0, 1.8965773822603143e-5),
        (200, 64.0, 5.1318160288243618e-42),
        (1_005_000, 1e6, 2.9340340480316411e-7),
    ] {
        assert_close(poisson_upper_p(k, mean), p, 1e-10);
    }
    for (k, mean, p) in
        [(0, 2.5, 0.082084998623898795), (3, 64.0, 7.3460419427059625e-24), (30, 64.0, 1.7040404195422438e-6)]
    {
        assert_close(poisson_lower_p(k, mean), p, 1e-10);
    }
    assert_eq!((poisson_lower_p(0, 0.0), poisson_upper_p(1, 0.0)), (1.0, 0.0));
}

#[test]
fn degenerate_probabilities_have_one_outcome() {
    assert_eq!((two_sided_p(0, 10, 0.0), two_sided_p(1, 10, 0.0)), (1.0, 0.0));
    assert_eq!((two_sided_p(10, 10, 1.0), two_sided_p(9, 10, 1.0)), (1.0, 0.0));
    assert_eq!(two_sided_p(0, 0, 0.3), 1.0);
}

/// scipy.stats.binomtest(...).proportion_ci(method="exact"), itself good to some 1e-10.
#[test]
fn intervals_match_a_reference() {
    for (k, n, alpha, low, high) in [
        (0, 10, 0.05, 0.0, 0.30849710781876083),
        (3, 10, 0.05, 0.06673951117773447, 0.6524528500599973),
        (10, 10, 0.05, 0.6915028921812392, 1.0),
        (420, 1_000_000, 1e-6, 0.00032729107405464697, 0.000529088649173075),
        (500, 1000, 0.01, 0.45885255330704494, 0.5411474466929551),
    ] {
        let (a, b) = clopper_pearson(k, n, alpha);
        assert_close(a, low, 1e-10);
        assert_close(b, high, 1e-10);
    }
}

/// 10 000 trials: the largest step of p is .008, small against the distance that is allowed.
#[test]
fn p_is_uniform_on_an_ideal_source() {
    assert_uniform_p("stats.binomial.two_sided_p", |rng| {
        two_sided_p((0..10_000).filter(|_| uniform01(rng) < 0.4).count() as u64, 10_000, 0.4)
    });
    // The number of arrivals before `mean`, by exponential gaps.
    let arrivals = |mean: f64, rng: &mut _| {
        let (mut time, mut count) = (0.0, 0);
        loop {
            time -= libm::log1p(-uniform01(rng));
            if time > mean {
                return count;
            }
            count += 1;
        }
    };
    assert_uniform_p("stats.binomial.poisson_upper_p", |rng| poisson_upper_p(arrivals(3000.0, rng), 3000.0));
    assert_uniform_p("stats.binomial.poisson_lower_p", |rng| poisson_lower_p(arrivals(3000.0, rng), 3000.0));
}

#[test]
fn a_biased_coin_is_rejected() {
    let mut rng = hashed_alpha::stats::seed::rng("stats.binomial.biased", 0);
    let heads = (0..100_000).filter(|_| uniform01(&mut rng) < 0.51).count() as u64;
    assert!(two_sided_p(heads, 100_000, 0.5) < 1e-6);
    assert!(clopper_pearson(heads, 100_000, 1e-6).0 > 0.5);
}
