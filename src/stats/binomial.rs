//! Exact tails of counts: binomial and Poisson.
//!
//! A tail is summed outwards from the observed count, where all terms are positive and fall off, after a
//! first term from Loader's saddle-point form. That keeps the relative error below 1e-10 down to 1e-300 and
//! for a million of trials, where the usual continued fraction of the incomplete beta function has long lost
//! its digits. A tail of n trials takes some multiple of sqrt(n) steps.

use std::f64::consts::PI;

/// Gives P(X >= k) for X binomial with `n` trials of probability `q`.
///
/// In `[0, 1]`: 1 for `k = 0` and 0 for `k > n`.
///
/// # Panics
/// If `q` is NaN or not in `[0, 1]`.
#[must_use]
pub fn upper_p(k: u64, n: u64, q: f64) -> f64 {
    assert!((0.0..=1.0).contains(&q), "{q} is not a probability");
    if k == 0 {
        1.0
    } else if k > n {
        0.0
    } else if k as f64 <= n as f64 * q {
        1.0 - lower_p(k - 1, n, q)
    } else {
        let odds = q / (1.0 - q);
        sum_falling(binomial_pmf(k, n, q), (k..n).map(|j| (n - j) as f64 / (j + 1) as f64 * odds))
    }
}

/// Gives P(X <= k) for X binomial with `n` trials of probability `q`.
///
/// In `[0, 1]`: 1 for `k >= n`.
///
/// # Panics
/// If `q` is NaN or not in `[0, 1]`.
#[must_use]
pub fn lower_p(k: u64, n: u64, q: f64) -> f64 {
    assert!((0.0..=1.0).contains(&q), "{q} is not a probability");
    if k >= n {
        1.0
    } else if k as f64 >= n as f64 * q {
        1.0 - upper_p(k + 1, n, q)
    } else {
        let odds = (1.0 - q) / q;
        sum_falling(binomial_pmf(k, n, q), (1..=k).rev().map(|j| j as f64 / (n - j + 1) as f64 * odds))
    }
}

/// Gives the two-sided p-value of `k` events in `n` trials of probability `q`: twice the smaller tail, at
/// most 1.
///
/// Being discrete it is not quite uniform under the hypothesis but never too small: P(p <= a) <= a.
///
/// # Panics
/// If `q` is NaN or not in `[0, 1]`, or `k > n`.
#[must_use]
pub fn two_sided_p(k: u64, n: u64, q: f64) -> f64 {
    assert!(k <= n, "{k} events in {n} trials");
    (2.0 * lower_p(k, n, q).min(upper_p(k, n, q))).min(1.0)
}

/// Gives P(X >= k) for X Poisson with the given mean.
///
/// # Panics
/// If `mean` is negative or not finite.
#[must_use]
pub fn poisson_upper_p(k: u64, mean: f64) -> f64 {
    assert!(mean >= 0.0 && mean.is_finite(), "mean {mean} of a count");
    if k == 0 {
        1.0
    } else if k as f64 <= mean {
        1.0 - poisson_lower_p(k - 1, mean)
    } else {
        sum_falling(poisson_pmf(k, mean), (k + 1..).map(|j| mean / j as f64))
    }
}

/// Gives P(X <= k) for X Poisson with the given mean.
///
/// # Panics
/// If `mean` is negative or not finite.
#[must_use]
pub fn poisson_lower_p(k: u64, mean: f64) -> f64 {
    assert!(mean >= 0.0 && mean.is_finite(), "mean {mean} of a count");
    if k as f64 >= mean {
        1.0 - poisson_upper_p(k + 1, mean)
    } else {
        sum_falling(poisson_pmf(k, mean), (1..=k).rev().map(|j| j as f64 / mean))
    }
}

/// Gives the interval of probabilities that are consistent with `k` events in `n` trials.
///
/// Closed ends `(low, high)`; the true probability is missed with probability at most `alpha`, half of it on
/// each side. `k = 0` gives the low end 0 and `k = n` the high end 1. Source: Clopper and Pearson 1934,
/// Biometrika 26.
///
/// # Panics
/// If `k > n`, `n` is 0, or `alpha` is not in `(0, 1)`.
#[must_use]
pub fn clopper_pearson(k: u64, n: u64, alpha: f64) -> (f64, f64) {
    assert!(k <= n && n > 0, "{k} events in {n} trials");
    assert!(alpha > 0.0 && alpha < 1.0, "alpha {alpha} is not in (0, 1)");
    let low = if k == 0 { 0.0 } else { boundary(|q| upper_p(k, n, q) < alpha / 2.0) };
    let high = if k == n { 1.0 } else { boundary(|q| lower_p(k, n, q) >= alpha / 2.0) };
    (low, high)
}

/// The point of `[0, 1]` where a predicate turns from true to false, to the last bit.
fn boundary(holds: impl Fn(f64) -> bool) -> f64 {
    let (mut yes, mut no) = (0.0, 1.0);
    loop {
        let middle = 0.5 * (yes + no);
        if middle <= yes || middle >= no {
            return middle;
        }
        if holds(middle) {
            yes = middle;
        } else {
            no = middle;
        }
    }
}

/// Sums `first` and its successors, each the last one times the next ratio, until they no longer count.
fn sum_falling(first: f64, ratios: impl Iterator<Item = f64>) -> f64 {
    let (mut sum, mut term) = (first, first);
    for ratio in ratios {
        term *= ratio;
        if term <= 1e-19 * sum {
            break;
        }
        sum += term;
    }
    sum
}

/// P(X = k) for X binomial. Source: Loader 2000, "Fast and accurate computation of binomial probabilities".
pub(super) fn binomial_pmf(k: u64, n: u64, q: f64) -> f64 {
    if q == 0.0 || q == 1.0 {
        return if k == (if q == 0.0 { 0 } else { n }) { 1.0 } else { 0.0 };
    }
    if k == 0 {
        return libm::exp(n as f64 * libm::log1p(-q));
    }
    if k == n {
        return libm::exp(n as f64 * libm::log(q));
    }
    binomial_density(k as f64, (n - k) as f64, q, 1.0 - q)
}

/// The same for hits and misses above 0 that need not be whole: q^hits r^misses / ((hits + misses + 1) B(hits +
/// 1, misses + 1)), with r = 1 - q.
pub(super) fn binomial_density(hits: f64, misses: f64, q: f64, r: f64) -> f64 {
    let trials = hits + misses;
    let log = stirling_error(trials)
        - stirling_error(hits)
        - stirling_error(misses)
        - deviance(hits, trials * q)
        - deviance(misses, trials * r);
    libm::exp(log) * (trials / (2.0 * PI * hits * misses)).sqrt()
}

/// P(X = k) for X Poisson; the same source.
pub(super) fn poisson_pmf(k: u64, mean: f64) -> f64 {
    if k == 0 {
        return libm::exp(-mean);
    }
    if mean == 0.0 {
        return 0.0;
    }
    let k = k as f64;
    libm::exp(-stirling_error(k) - deviance(k, mean)) / (2.0 * PI * k).sqrt()
}

/// ln(x!) minus Stirling's formula, for x above 0.
fn stirling_error(x: f64) -> f64 {
    if x < 16.0 {
        return libm::lgamma(x + 1.0) - (x + 0.5) * libm::log(x) + x - 0.5 * libm::log(2.0 * PI);
    }
    let s = 1.0 / (x * x);
    (1.0 / 12.0 - s * (1.0 / 360.0 - s * (1.0 / 1260.0 - s * (1.0 / 1680.0 - s / 1188.0)))) / x
}

/// x ln(x/m) + m - x without cancellation where x is near m.
fn deviance(x: f64, m: f64) -> f64 {
    if (x - m).abs() >= 0.1 * (x + m) {
        return x * libm::log(x / m) + m - x;
    }
    let v = (x - m) / (x + m);
    let (mut sum, mut power) = ((x - m) * v, 2.0 * x * v);
    for j in 1.. {
        power *= v * v;
        let next = sum + power / f64::from(2 * j + 1);
        if next == sum {
            break;
        }
        sum = next;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::super::calibration::{assert_close, assert_uniform_p};
    use super::super::seed::uniform01;
    use super::*;

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
        for (k, mean, p) in [
            (0, 2.5, 0.082084998623898795),
            (3, 64.0, 7.3460419427059625e-24),
            (30, 64.0, 1.7040404195422438e-6),
        ] {
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
        assert_uniform_p("stats.binomial.poisson_upper_p", |rng| {
            poisson_upper_p(arrivals(3000.0, rng), 3000.0)
        });
        assert_uniform_p("stats.binomial.poisson_lower_p", |rng| {
            poisson_lower_p(arrivals(3000.0, rng), 3000.0)
        });
    }

    #[test]
    fn a_biased_coin_is_rejected() {
        let mut rng = super::super::seed::rng("stats.binomial.biased", 0);
        let heads = (0..100_000).filter(|_| uniform01(&mut rng) < 0.51).count() as u64;
        assert!(two_sided_p(heads, 100_000, 0.5) < 1e-6);
        assert!(clopper_pearson(heads, 100_000, 1e-6).0 > 0.5);
    }
}
