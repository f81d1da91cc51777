//! Means that should be zero, and the worst of them.
//!
//! Pixels of one image depend on each other in ways that hardly have a closed form; images at places of their own do
//! not depend on each other at all. So each image gives numbers whose expectation is known, and their mean is judged: by
//! the law of what it is made of where that is known, by Student's law otherwise.

use crate::check::tolerance::{POWER, SINGLE_LEVEL};
use crate::check::{Conclusion, Evidence, Trial};
use crate::stats::variance::Variance;
use crate::stats::{beta, normal};

/// The mean of independent numbers that should average to zero.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mean {
    /// What was measured, for the report.
    pub name: String,
    /// Mean of the replicates.
    pub mean: f64,
    /// Its standard error.
    pub sigma: f64,
    /// Two-sided probability of a mean as far from 0.
    pub p: f64,
}

impl Mean {
    /// Judges replicates by their own spread, with Student's law; `None` for fewer than two.
    pub fn of(name: impl Into<String>, replicates: &[f64]) -> Option<Self> {
        let found = Variance::of(replicates).ok()?;
        let is_exact = found.variance == 0.0 && found.mean == 0.0;
        Some(Self {
            name: name.into(),
            mean: found.mean,
            sigma: (found.variance / replicates.len() as f64).sqrt(),
            p: if is_exact { 1.0 } else { found.mean_p(0.0) },
        })
    }
}

/// The smallest mean of so many replicates that would have been seen, wherever it were, by Student's law.
pub(crate) fn detectable(means: &[Mean], replicates: usize) -> Option<f64> {
    let dof = (replicates as u64).checked_sub(1).filter(|&dof| dof > 0)?;
    let sigma = means.iter().map(|mean| mean.sigma).reduce(f64::max)?;
    let level = SINGLE_LEVEL / means.len() as f64;
    let (mut low, mut high) = (0.0, 1.0);
    while beta::student_two_sided_p(high, dof) > level {
        (low, high) = (high, 2.0 * high);
    }
    while high - low > 1e-6 * high {
        let middle = 0.5 * (low + high);
        if beta::student_two_sided_p(middle, dof) > level { low = middle } else { high = middle }
    }
    Some((high + normal::quantile(POWER)) * sigma)
}

/// A trial that rests on the worst of several means, all in units of one effect and judged by one law, of which
/// `detectable` would have been seen.
pub(crate) fn worst_of(
    means: &[Mean],
    law: &str,
    detectable: Option<f64>,
    n: u64,
    effect_name: &'static str,
    seen: impl Fn(&Mean) -> String,
    evidence: Evidence,
) -> Trial {
    let Some(worst) = means.iter().min_by(|a, b| a.p.total_cmp(&b.p)) else {
        return Trial::without(Conclusion::Inconclusive, "there were no replicates");
    };
    Trial {
        conclusion: Conclusion::Probability((worst.p * means.len() as f64).min(1.0)),
        statistic: Some(worst.mean / worst.sigma),
        statistic_name: format!("{law}, worst of {}", means.len()),
        n,
        effect: means.iter().map(|mean| mean.mean.abs()).reduce(f64::max),
        effect_name,
        detectable,
        seen: seen(worst),
        evidence,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_replicates_that_are_all_zero_say_nothing() {
        let p = |replicates: &[f64]| Mean::of("", replicates).map(|mean| mean.p);
        assert_eq!(p(&[0.0; 4]), Some(1.0));
        assert_eq!(p(&[0.3; 4]), Some(0.0));
        assert_eq!(p(&[0.3]), None);
        assert!(p(&[0.1, -0.2, 0.1, 0.1]).is_some_and(|p| p > 0.5 && p < 1.0));
    }
}
