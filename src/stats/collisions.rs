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
    use super::*;

    fn assert_close(actual: f64, expected: f64, relative: f64) {
        assert!((actual / expected - 1.0).abs() <= relative, "{actual:e} is not {expected:e}");
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
}
