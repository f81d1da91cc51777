//! Collisions: how often values that should be spread over many urns meet in one.
//!
//! The test sees structure that a histogram cannot, with far fewer values than urns.

use super::Tails;
use super::binomial::{poisson_lower_p, poisson_upper_p};

/// Steps up to which the law is computed exactly (half a second at the limit).
const EXACT_STEPS: f64 = 1e8;

/// Holds a number of collisions and its judgement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collisions {
    /// How many values met an urn that was not empty.
    pub observed: u64,
    /// Expectation of that number.
    pub expected: f64,
    /// Its tails. The upper one tells of structure, the lower one of stratified values.
    pub tails: Tails,
    /// Tells whether the tails are exact; otherwise they are those of a Poisson law.
    pub is_exact: bool,
}

/// Counts the values that equal an earlier one. Sorts them.
#[must_use]
pub fn count_repeats(values: &mut [u64]) -> u64 {
    values.sort_unstable();
    values.windows(2).filter(|pair| pair[0] == pair[1]).count() as u64
}

/// Judges a number of collisions among `n` values, each in one of `urns` equally likely urns.
///
/// The law is exact while `n` times `observed` is at most 1e8: values are thrown one by one, and the
/// probabilities of a number of collisions so far are followed up to `observed`; a relative error below 1e-10 down
/// to 1e-300. Beyond, it is the Poisson law of the exact mean, for n below urns/10. That errs on the safe side in
/// the tails: z standard deviations away it is too large by a relative z² n/urns at most, and in the middle too
/// small by n/(3 urns) at most.
///
/// Source: Knuth, The Art of Computer Programming 2, 3.3.2 I.
///
/// # Panics
/// If `urns` is 0, or `observed` is not below `n`.
#[must_use]
pub fn collisions(observed: u64, n: u64, urns: u64) -> Collisions {
    assert!(urns > 0 && observed < n, "{observed} collisions of {n} values in {urns} urns");
    let expected = mean(n as f64, urns as f64);
    let is_exact = n as f64 * (observed + 1) as f64 <= EXACT_STEPS;
    let tails = if is_exact {
        exact_tails(observed, n, urns as f64)
    } else {
        Tails { lower: poisson_lower_p(observed, expected), upper: poisson_upper_p(observed, expected) }
    };
    Collisions { observed, expected, tails, is_exact }
}

/// n - k (1 - (1 - 1/k)^n), the values less the urns that are not empty.
fn mean(n: f64, k: f64) -> f64 {
    if n > k {
        return n + k * libm::expm1(n * libm::log1p(-1.0 / k));
    }
    // The binomial series, which does not cancel: over j of (-1)^j (n over j) / k^(j-1).
    let mut term = n * (n - 1.0) / (2.0 * k);
    let mut sum = term;
    for j in 2.. {
        let j = f64::from(j);
        term *= -(n - j) / ((j + 1.0) * k);
        sum += term;
        if term.abs() <= 1e-18 * sum {
            break;
        }
    }
    sum
}

/// The exact law: `weight[j]` is the probability of j collisions so far.
fn exact_tails(observed: u64, n: u64, urns: f64) -> Tails {
    let last = observed as usize;
    let mut weight = vec![0.0; last + 1];
    weight[0] = 1.0;
    let mut above = 0.0;
    for thrown in 0..n as usize {
        let hit = |j: usize| (thrown - j) as f64 / urns;
        let most = last.min(thrown);
        above += if most == last { weight[last] * hit(last) } else { 0.0 };
        for j in (0..=most).rev() {
            let from_below = if j > 0 { weight[j - 1] * hit(j - 1) } else { 0.0 };
            weight[j] = weight[j] * (1.0 - hit(j)) + from_below;
        }
    }
    let lower = weight.iter().sum::<f64>().min(1.0);
    Tails { lower, upper: (above + weight[last]).min(1.0) }
}

#[cfg(test)]
mod tests {
    use super::super::calibration::assert_close;
    use super::super::chi_square;
    use super::super::seed::{rng, uniform01};
    use super::*;

    /// Every way to throw 6 values in 4 urns, and 4 in 6.
    #[test]
    fn small_cases_are_enumerated() {
        for (n, urns) in [(6_u64, 4_u64), (4, 6), (3, 1), (1, 5)] {
            let ways = urns.pow(n as u32);
            let repeats = |way: u64| {
                count_repeats(&mut (0..n).map(|i| way / urns.pow(i as u32) % urns).collect::<Vec<_>>())
            };
            let counts: Vec<u64> = (0..ways).map(repeats).collect();
            let share = |holds: &dyn Fn(u64) -> bool| {
                counts.iter().filter(|&&count| holds(count)).count() as f64 / ways as f64
            };
            for observed in 0..n {
                let found = collisions(observed, n, urns);
                assert!(found.is_exact);
                assert!((found.tails.lower - share(&|count| count <= observed)).abs() < 1e-15);
                assert!((found.tails.upper - share(&|count| count >= observed)).abs() < 1e-15);
                assert_close(
                    found.expected + 1.0,
                    counts.iter().sum::<u64>() as f64 / ways as f64 + 1.0,
                    1e-14,
                );
            }
        }
    }

    /// No collision at all: Π (1 - i/k). All in one urn: k^(1-n).
    #[test]
    fn tails_are_true_tails() {
        let none: f64 = (0..2000).map(|i| 1.0 - f64::from(i) / 10_000.0).product();
        assert_close(collisions(0, 2000, 10_000).tails.lower, none, 1e-12);
        assert_close(collisions(99, 100, 1000).tails.upper, 1e-297, 1e-12);
    }

    #[test]
    fn means_do_not_cancel() {
        // Half of all pairs, less a third of the triples.
        let (n, k) = (1_000_000_u64, 1_u64 << 60);
        let pairs = (n * (n - 1) / 2) as f64 / k as f64;
        assert_close(mean(n as f64, k as f64), pairs * (1.0 - (n - 2) as f64 / (3.0 * k as f64)), 1e-15);
        assert_close(mean(1000.0, 1001.0), mean(1000.0 + 1e-9, 1000.0), 1e-3);
        assert_eq!(mean(5.0, 1.0), 4.0);
    }

    /// Where the exact law is too long to compute, the Poisson law is too wide, by little.
    #[test]
    fn the_poisson_law_errs_on_the_safe_side() {
        let (n, urns) = (4096, 1 << 20);
        for observed in [2, 13, 19, 24] {
            let exact = collisions(observed, n, urns);
            let z = (observed as f64 - exact.expected) / exact.expected.sqrt();
            let poisson =
                [poisson_lower_p(observed, exact.expected), poisson_upper_p(observed, exact.expected)];
            let (exact, poisson) =
                if z < 0.0 { (exact.tails.lower, poisson[0]) } else { (exact.tails.upper, poisson[1]) };
            let excess = poisson / exact - 1.0;
            assert!(excess > 0.0 && excess < z * z * n as f64 / urns as f64, "{observed}: {excess}");
        }
    }

    /// The observed shares of each outcome of 4000 runs follow the law.
    fn follows(outcomes: &[u64], law: impl Fn(u64) -> Tails) {
        let share = |count: u64| law(count).upper - law(count + 1).upper;
        let last = outcomes.len() as u64 - 1;
        let expected: Vec<f64> = (0..last).map(share).chain(std::iter::once(law(last).upper)).collect();
        let found = chi_square::against(outcomes, &expected).unwrap();
        assert!(found.p > 1e-4, "{} {outcomes:?}", found.p);
    }

    fn histogram(mut run: impl FnMut() -> u64) -> Vec<u64> {
        let mut outcomes = vec![0; 16];
        for _ in 0..4000 {
            outcomes[(run() as usize).min(15)] += 1;
        }
        outcomes
    }

    #[test]
    fn an_ideal_source_follows_the_law() {
        let mut source = rng("stats.collisions.ideal", 0);
        let repeats = |rng: &mut _| {
            count_repeats(&mut (0..256).map(|_| (uniform01(rng) * 8192.0) as u64).collect::<Vec<_>>())
        };
        follows(&histogram(|| repeats(&mut source)), |count| collisions(count, 256, 8192).tails);
    }

    /// Values on one tenth of the urns collide ten times as often; stratified ones never do.
    #[test]
    fn broken_sources_are_rejected() {
        let mut rng = rng("stats.collisions.broken", 0);
        let mut atoms: Vec<u64> = (0..4096).map(|_| (uniform01(&mut rng) * 26_214.4) as u64 * 10).collect();
        let found = collisions(count_repeats(&mut atoms), 4096, 1 << 18);
        assert!(found.tails.upper < 1e-100);
        let mut strata: Vec<u64> = (0..4096).map(|i| i * 64).collect();
        assert!(collisions(count_repeats(&mut strata), 4096, 1 << 18).tails.lower < 1e-13);
    }
}
