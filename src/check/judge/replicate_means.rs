//! Means of independent replicates: how claims about noise as a whole are tested.
//!
//! Pixels of one image depend on each other in ways that hardly have a closed form; images at places of their own do
//! not depend on each other at all. So each image gives one number whose expectation is known, and Student's law judges
//! their mean.

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
    /// Its standard error, from their spread.
    pub sigma: f64,
    /// Two-sided probability of a mean as far from 0.
    pub p: f64,
    dof: u64,
}

impl Mean {
    /// Judges replicates; `None` for fewer than two.
    pub fn of(name: impl Into<String>, replicates: &[f64]) -> Option<Self> {
        let found = Variance::of(replicates).ok()?;
        let is_exact = found.variance == 0.0 && found.mean == 0.0;
        Some(Self {
            name: name.into(),
            mean: found.mean,
            sigma: (found.variance / replicates.len() as f64).sqrt(),
            p: if is_exact { 1.0 } else { found.mean_p(0.0) },
            dof: found.dof,
        })
    }

    /// The smallest mean that would have been seen as one of `tests`.
    fn detectable(&self, tests: usize) -> f64 {
        let level = SINGLE_LEVEL / tests as f64;
        let (mut low, mut high) = (0.0, 1.0);
        while beta::student_two_sided_p(high, self.dof) > level {
            (low, high) = (high, 2.0 * high);
        }
        while high - low > 1e-6 * high {
            let middle = 0.5 * (low + high);
            if beta::student_two_sided_p(middle, self.dof) > level { low = middle } else { high = middle }
        }
        (high + normal::quantile(POWER)) * self.sigma
    }
}

/// A trial that rests on the worst of several means, all in units of one effect.
pub(crate) fn worst_of(
    means: &[Mean],
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
        statistic_name: format!("Student's t, {} dof, worst of {}", worst.dof, means.len()),
        n,
        effect: means.iter().map(|mean| mean.mean.abs()).reduce(f64::max),
        effect_name,
        detectable: means.iter().map(|mean| mean.detectable(means.len())).reduce(f64::max),
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
