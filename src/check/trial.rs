//! What is seen when a claim is tried on a subject.

use crate::check::shrink::describe;
use crate::check::tolerance::{POWER, SINGLE_LEVEL};
use crate::check::{Evidence, Subject};
use crate::scene::Fragment;
use crate::stats::chi_square::ChiSquare;
use crate::stats::power;

/// What a trial reached, or the trial that ended it early.
pub type Attempt<T> = Result<T, Box<Trial>>;

/// What one trial says by itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conclusion {
    /// A statement without chance in it holds or does not.
    Exact {
        /// Whether it holds.
        holds: bool,
    },
    /// The probability in [0, 1], under the claim, of evidence at least as strong as that seen: a p-value that already counts
    /// all statistics of the trial.
    Probability(f64),
    /// The samples were too few for an answer.
    Inconclusive,
    /// The subject could not be run.
    Unavailable,
    /// The claim says nothing about this subject.
    NotApplicable,
}

/// What was seen when a claim was tried on a subject once, before the other trials of the run are taken into account.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// The answer.
    pub conclusion: Conclusion,
    /// The test statistic.
    pub statistic: Option<f64>,
    /// What the statistic is, as in "chi-square, 63 dof".
    pub statistic_name: String,
    /// Samples that entered it.
    pub n: u64,
    /// Size of the effect seen, in the unit of `effect_name`.
    pub effect: Option<f64>,
    /// What the effect measures, as in "error in coverage".
    pub effect_name: &'static str,
    /// Smallest effect that would have been seen with power 0.999, in the same unit.
    pub detectable: Option<f64>,
    /// What was seen, in words; reported where the claim is rejected or without an answer.
    pub seen: String,
    /// What was seen, to be drawn.
    pub evidence: Evidence,
}

impl Trial {
    /// A trial with no more than a conclusion and what was seen, in words: one that could not be held, or that has its numbers
    /// still to come.
    #[must_use]
    pub fn without(conclusion: Conclusion, reason: impl Into<String>) -> Self {
        Self {
            conclusion,
            statistic: None,
            statistic_name: String::new(),
            n: 0,
            effect: None,
            effect_name: "",
            detectable: None,
            seen: reason.into(),
            evidence: Evidence::None,
        }
    }

    /// A trial of a statement without chance in it, which `bad` of `n` samples break.
    pub(crate) fn counted(
        bad: u64,
        n: u64,
        statistic_name: &str,
        effect_name: &'static str,
        seen: String,
    ) -> Self {
        Self {
            statistic: Some(bad as f64),
            statistic_name: statistic_name.into(),
            n,
            effect: Some(bad as f64 / n as f64),
            effect_name,
            detectable: Some(detectable_share(n as f64)),
            ..Self::without(Conclusion::Exact { holds: bad == 0 }, seen)
        }
    }

    /// A trial that rests on the smallest of several chi-square probabilities (Bonferroni).
    pub(crate) fn worst_of(tests: &[ChiSquare], n: u64, seen: String, evidence: Evidence) -> Self {
        let Some(worst) = tests.iter().min_by(|a, b| a.p.total_cmp(&b.p)) else {
            return Self::without(Conclusion::Inconclusive, "no group had enough samples");
        };
        let of_several = if tests.len() > 1 { format!(", worst of {}", tests.len()) } else { String::new() };
        Self {
            conclusion: Conclusion::Probability((worst.p * tests.len() as f64).min(1.0)),
            statistic: Some(worst.statistic),
            statistic_name: format!("chi-square, {} dof{of_several}", worst.dof),
            n,
            effect: Some(worst.effect),
            effect_name: "excess chi-square per sample",
            detectable: Some(power::detectable_effect_chi_square(
                worst.dof,
                worst.n,
                SINGLE_LEVEL / tests.len() as f64,
                POWER,
            )),
            seen,
            evidence,
        }
    }
}

/// The smallest share of bad samples of which at least one is among `n` with power 0.999.
pub(crate) fn detectable_share(n: f64) -> f64 {
    -libm::log(1.0 - POWER) / n
}

/// Ends a claim whose samples are not all thresholds.
pub(crate) fn reject_outsiders<F: Copy + Into<Fragment>>(
    subject: &Subject<'_>,
    samples: &[F],
    values: &[f64],
) -> Attempt<()> {
    let is_outside = |value: f64| !(0.0..=1.0).contains(&value);
    let Some(first) = values.iter().position(|&value| is_outside(value)) else { return Ok(()) };
    let (outside, n) = (values.iter().filter(|&&value| is_outside(value)).count(), values.len());
    let is_like_it = |_: &Fragment, value: f64| is_outside(value) && value.is_nan() == values[first].is_nan();
    let example = describe(subject, &samples[first].into(), is_like_it);
    let seen = format!("{outside} of {n} thresholds are NaN or outside [0, 1]; as in {example}");
    let name = "thresholds outside [0, 1]";
    Err(Box::new(Trial::counted(outside as u64, n as u64, name, "share of samples", seen)))
}
