//! What came out of one claim tried on one subject.

use super::Evidence;
use core::fmt;

/// The answer to a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// Nothing seen speaks against the claim.
    Consistent,
    /// The evidence rules the claim out at the family-wise level.
    Rejected,
    /// Too few samples to see the effect that the claim is about.
    Inconclusive,
    /// The subject could not be run.
    Unavailable,
    /// The claim says nothing about this subject.
    NotApplicable,
}

impl Verdict {
    /// The word by which reports name it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Consistent => "consistent",
            Self::Rejected => "rejected",
            Self::Inconclusive => "inconclusive",
            Self::Unavailable => "unavailable",
            Self::NotApplicable => "not_applicable",
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// One line of a report.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Identifier of the claim, `family.claim`.
    pub check: &'static str,
    /// Place in the paper, as in "§5, Listing 1".
    pub anchor: &'static str,
    /// The claim in one sentence.
    pub statement: &'static str,
    /// Who was tried, as in "paper:isotropic".
    pub subject: String,
    /// "f32" or "f64".
    pub precision: &'static str,
    /// The answer.
    pub verdict: Verdict,
    /// The answer that a sound subject gives: [`Verdict::Rejected`] for a negative control, else
    /// [`Verdict::Consistent`].
    pub expected: Verdict,
    /// The test statistic.
    pub statistic: Option<f64>,
    /// What the statistic is, as in "chi-square, 63 dof".
    pub statistic_name: String,
    /// Samples that entered the statistic.
    pub n: u64,
    /// p-value of the claim alone, in [0, 1]; absent for exact claims.
    pub p: Option<f64>,
    /// p-value after Holm's correction over all claims of the last round that tried it, in [0, 1].
    pub p_holm: Option<f64>,
    /// How often the claim was tried: once, or up to three times where it looked suspect.
    pub rounds: u32,
    /// Size of the effect that was seen, in the unit of `effect_name`.
    pub effect: Option<f64>,
    /// What the effect measures, as in "excess chi-square per sample".
    pub effect_name: &'static str,
    /// The smallest effect that the claim would have seen with power 0.999.
    pub detectable: Option<f64>,
    /// Seed of the run.
    pub seed: u64,
    /// What was found, in words; absent where the claim holds without remark.
    pub finding: Option<String>,
    /// Why a rejection does not surprise, where a list of known findings names it.
    pub known: Option<String>,
    /// Why the paper's own listing fails this claim, where it is known to.
    pub listing_fails: Option<&'static str>,
    /// What was seen, to be drawn.
    pub evidence: Evidence,
}

impl Outcome {
    /// Returns whether the answer is the one that a sound subject gives, or says that there was nothing to answer.
    #[must_use]
    pub fn as_expected(&self) -> bool {
        self.verdict == self.expected || self.verdict == Verdict::NotApplicable
    }

    /// Returns whether there is an answer.
    #[must_use]
    pub fn is_answered(&self) -> bool {
        matches!(self.verdict, Verdict::Consistent | Verdict::Rejected)
    }

    /// Returns whether the answer speaks against the subject: not as expected, and not known either.
    #[must_use]
    pub fn is_news(&self) -> bool {
        !self.as_expected() && self.known.is_none()
    }
}

/// The verdict, the claim, what was seen, and by what numbers.
impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} ({})\n  claim: {}", self.verdict, self.check, self.anchor, self.statement)?;
        if let Some(finding) = &self.finding {
            write!(f, "\n  seen: {finding}")?;
        }
        write!(f, "\n  n = {}", self.n)?;
        if let Some(statistic) = self.statistic {
            write!(f, ", {} = {statistic:.5}", self.statistic_name)?;
        }
        if let (Some(p), Some(p_holm)) = (self.p, self.p_holm) {
            write!(f, ", p = {p:.3e}, {p_holm:.3e} among all claims")?;
        }
        if let Some(effect) = self.effect {
            write!(f, "\n  {}: {effect:.4e}", self.effect_name)?;
        }
        if let Some(detectable) = self.detectable {
            write!(f, "; {detectable:.4e} would have been seen")?;
        }
        Ok(())
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// An outcome of which only claim and verdict matter.
    pub(crate) fn outcome(check: &'static str, verdict: Verdict) -> Outcome {
        Outcome {
            check,
            anchor: "§5",
            statement: "",
            subject: "s".into(),
            precision: "f32",
            verdict,
            expected: Verdict::Consistent,
            statistic: None,
            statistic_name: String::new(),
            n: 1,
            p: None,
            p_holm: None,
            rounds: 1,
            effect: None,
            effect_name: "",
            detectable: None,
            seed: 0,
            finding: None,
            known: None,
            listing_fails: None,
            evidence: Evidence::None,
        }
    }
}
