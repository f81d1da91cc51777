//! What came out of one claim tried on one subject.

use super::domain::Domain;
use super::evidence::Evidence;
use super::subject::Precision;
use crate::threshold::two_scale::Variant;
use core::fmt;
use std::borrow::Cow;

/// The answer to a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
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

/// What an outcome is worth to whoever reads the run, the most urgent first.
///
/// Decided here and nowhere else: the text, the page, JSON, the exit code, [`Results::assert`](super::Results::assert) and
/// [`diagnosis`](super::diagnosis) all read it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Standing {
    /// The answer speaks against the subject: a claim is rejected that no list of known findings names, or a negative control
    /// is not rejected.
    Against,
    /// There should be an answer, and there is none: too few samples, or the subject could not be run.
    Unanswered,
    /// A claim is rejected, and a list of known findings names it.
    Known,
    /// The answer is the one that a sound subject gives.
    AsExpected,
    /// The claim says nothing about this subject.
    NotApplicable,
}

impl Standing {
    /// The word by which data formats name it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Against => "against",
            Self::Unanswered => "unanswered",
            Self::Known => "known",
            Self::AsExpected => "as_expected",
            Self::NotApplicable => "not_applicable",
        }
    }

    /// Returns whether the subject has something left to show: it speaks against it, or it is unanswered.
    #[must_use]
    pub const fn is_news(self) -> bool {
        match self {
            Self::Against | Self::Unanswered => true,
            Self::Known | Self::AsExpected | Self::NotApplicable => false,
        }
    }
}

/// How a rejection compares with that of the paper's own listing by the same claim.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LikeTheListing {
    /// Whether it is the same failure: of the same effect, no larger, and for a reason that is true of the subject.
    pub is_like: bool,
    /// The two sizes, or what is different.
    pub words: String,
}

/// One claim tried on one subject: a line of a report.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Outcome {
    /// Identifier of the claim, `family.claim`.
    pub check: &'static str,
    /// Place in the paper, as in "§5, Listing 1".
    pub anchor: &'static str,
    /// The claim in one sentence.
    pub statement: &'static str,
    /// Who was tried, as in "paper:isotropic".
    pub subject: String,
    /// The listing that the subject claims to follow.
    pub variant: Variant,
    /// The arithmetic in which the subject works.
    pub precision: Precision,
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
    /// What of all footprints, frames and layers was sampled, in the last round; nothing where the subject could not be run.
    pub domain: Domain,
    /// Seed of the run.
    pub seed: u64,
    /// What was seen, in words; absent where the claim is consistent.
    pub seen: Option<String>,
    /// Why a rejection does not surprise, where a list of known findings names it ([`known::mark`](super::known::mark)).
    pub known: Option<Cow<'static, str>>,
    /// How a rejection compares with that of the paper's listing, where that is known to be rejected, too.
    pub listing: Option<LikeTheListing>,
    /// What was seen, to be drawn.
    pub evidence: Evidence,
}

impl Outcome {
    /// What the outcome is worth.
    #[must_use]
    pub fn standing(&self) -> Standing {
        match self.verdict {
            Verdict::NotApplicable => Standing::NotApplicable,
            Verdict::Inconclusive | Verdict::Unavailable => Standing::Unanswered,
            Verdict::Consistent | Verdict::Rejected => {
                if self.verdict == self.expected {
                    Standing::AsExpected
                } else if self.verdict == Verdict::Rejected && self.known.is_some() {
                    Standing::Known
                } else {
                    Standing::Against
                }
            }
        }
    }

    /// Returns whether the claim is a negative control, which a sound subject fails.
    #[must_use]
    pub fn is_control(&self) -> bool {
        self.expected == Verdict::Rejected
    }

    /// The answer in words that say whether a negative control did its work and whether a rejection was known.
    #[must_use]
    pub fn answer(&self) -> &'static str {
        match (self.standing(), self.is_control()) {
            (Standing::AsExpected, true) => "rejected, as it must be",
            (Standing::Against, true) => "not rejected, though it must be",
            (Standing::Known, _) => "rejected, as known",
            (Standing::NotApplicable, _) => "not applicable",
            (Standing::AsExpected | Standing::Against, false) | (Standing::Unanswered, _) => {
                self.verdict.name()
            }
        }
    }
}

/// Returns what a run is worth: the most urgent standing of its outcomes.
#[must_use]
pub fn worst(outcomes: &[Outcome]) -> Standing {
    outcomes.iter().map(Outcome::standing).min().unwrap_or(Standing::NotApplicable)
}

/// The verdict, the claim, what was seen, and by what numbers.
impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} ({})\n  claim: {}", self.answer(), self.check, self.anchor, self.statement)?;
        if let Some(seen) = &self.seen {
            write!(f, "\n  seen: {seen}")?;
        }
        write!(f, "\n  n = {}", self.n)?;
        if let Some(statistic) = self.statistic {
            write!(f, ", {} = {statistic:.5}", self.statistic_name)?;
        }
        if let (Some(p), Some(p_holm)) = (self.p, self.p_holm) {
            // What is smaller is no longer a number.
            let said = |p: f64| if p < 1.0e-300 { "below 1e-300".to_owned() } else { format!("{p:.3e}") };
            write!(f, ", p = {}, {} among all claims", said(p), said(p_holm))?;
        }
        if let Some(effect) = self.effect {
            write!(f, "\n  {}: {effect:.4e}", self.effect_name)?;
        }
        if let Some(detectable) = self.detectable {
            write!(f, "; {detectable:.4e} would have been seen")?;
        }
        if self.domain.n > 0 {
            write!(f, "\n  sampled: {}", self.domain)?;
        }
        Ok(())
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// An outcome of which only claim and verdict matter, of a variant that is no listing.
    pub(crate) fn outcome(check: &'static str, verdict: Verdict) -> Outcome {
        Outcome {
            check,
            anchor: "§5",
            statement: "",
            subject: "s".into(),
            variant: Variant::Single,
            precision: Precision::F32,
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
            domain: Domain::default(),
            seed: 0,
            seen: None,
            known: None,
            listing: None,
            evidence: Evidence::None,
        }
    }
    #[test]
    fn a_standing_weighs_the_verdict_against_what_was_expected_and_known() {
        let of = |verdict, expected, known: bool| Outcome {
            expected,
            known: known.then(|| "why".into()),
            ..outcome("a", verdict)
        };
        use Verdict::{Consistent, Inconclusive, NotApplicable, Rejected, Unavailable};
        for (verdict, expected, known, standing, answer) in [
            (Consistent, Consistent, false, Standing::AsExpected, "consistent"),
            (Rejected, Consistent, false, Standing::Against, "rejected"),
            (Rejected, Consistent, true, Standing::Known, "rejected, as known"),
            (Rejected, Rejected, false, Standing::AsExpected, "rejected, as it must be"),
            (Consistent, Rejected, false, Standing::Against, "not rejected, though it must be"),
            (Inconclusive, Consistent, false, Standing::Unanswered, "inconclusive"),
            (Inconclusive, Consistent, true, Standing::Unanswered, "inconclusive"),
            (Unavailable, Rejected, false, Standing::Unanswered, "unavailable"),
            (NotApplicable, Rejected, false, Standing::NotApplicable, "not applicable"),
        ] {
            let found = of(verdict, expected, known);
            assert_eq!((found.standing(), found.answer()), (standing, answer));
        }
    }

    #[test]
    fn a_rejection_outweighs_a_missing_answer() {
        let of = |verdicts: &[Verdict]| {
            worst(&verdicts.iter().map(|&verdict| outcome("a", verdict)).collect::<Vec<_>>())
        };
        assert_eq!(of(&[Verdict::Consistent, Verdict::NotApplicable]), Standing::AsExpected);
        assert_eq!(of(&[Verdict::Consistent, Verdict::Unavailable]), Standing::Unanswered);
        assert_eq!(of(&[Verdict::Unavailable, Verdict::Rejected]), Standing::Against);
        assert_eq!(of(&[]), Standing::NotApplicable);
    }
}
