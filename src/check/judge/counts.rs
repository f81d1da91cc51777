//! Counts of rare events, under the law of Poisson.

use crate::check::tolerance::{POWER, SINGLE_LEVEL};
use crate::stats::binomial;

/// The smallest excess of a Poisson count of this mean that would be seen, as a factor.
pub(crate) fn detectable_factor(mean: f64) -> f64 {
    let critical =
        (0..).find(|&count| binomial::poisson_upper_p(count, mean) < SINGLE_LEVEL).unwrap_or(u64::MAX);
    let unseen = |factor: f64| binomial::poisson_lower_p(critical - 1, factor * mean);
    (4..)
        .map(|quarter| f64::from(quarter) / 4.0)
        .find(|&factor| unseen(factor) <= 1.0 - POWER)
        .unwrap_or(f64::INFINITY)
}
