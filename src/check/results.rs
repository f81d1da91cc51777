//! The answers of one run about one subject, as somebody's own test suite wants them.

use super::Subject;
use super::cause::{self, Found};
use super::diagnosis;
use super::draw::Reach;
use super::known::{self, OF_THE_LISTINGS};
use super::outcome::{self, Outcome, Standing};
use super::tolerance::GUESSES;
use core::fmt;

/// What a subject is measured by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Suite {
    /// Every claim, the hard cases among them: what a threshold should do.
    #[default]
    All,
    /// As good as the paper: a rejection counts unless the paper's own listing is known to fail there too, by as much and for a
    /// reason that is true of the subject ([`known`](super::known)).
    Paper,
}

impl Suite {
    /// Both suites.
    pub const ALL: [Self; 2] = [Self::All, Self::Paper];

    /// How far it asks a threshold to hold.
    #[must_use]
    pub const fn reach(self) -> Reach {
        match self {
            Self::All => Reach::Whole,
            Self::Paper => Reach::Listings,
        }
    }

    /// The word by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::Paper => "paper",
        }
    }
}

/// What every claim said about a subject.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Results {
    /// One outcome a claim, in the order of the claims.
    pub outcomes: Vec<Outcome>,
    /// What the subject is measured by.
    pub suite: Suite,
    /// Slips of the subject that experiments on it have shown; empty where nothing speaks against it.
    pub causes: Vec<Found>,
}

impl Results {
    /// Takes the outcomes of a run; under [`Suite::Paper`] what the paper's own listing fails is marked as known.
    #[must_use]
    pub fn new(mut outcomes: Vec<Outcome>, suite: Suite) -> Self {
        if suite == Suite::Paper {
            known::mark(&mut outcomes, OF_THE_LISTINGS);
        }
        Self { outcomes, suite, causes: Vec::new() }
    }

    /// Asks a subject that is rejected for its slips.
    #[must_use]
    pub fn examined(self, subject: &Subject<'_>) -> Self {
        let causes = if self.is_consistent() { Vec::new() } else { cause::examine(subject).found };
        Self { causes, ..self }
    }

    /// Returns the outcomes that speak against the subject.
    pub fn news(&self) -> impl Iterator<Item = &Outcome> {
        self.outcomes.iter().filter(|outcome| outcome.standing().is_news())
    }

    /// Returns whether nothing speaks against the subject.
    #[must_use]
    pub fn is_consistent(&self) -> bool {
        !outcome::worst(&self.outcomes).is_news()
    }

    /// Does nothing where [`Results::is_consistent`] holds.
    ///
    /// # Panics
    ///
    /// Otherwise, with a message that names every claim that speaks against the subject, and what was seen.
    #[track_caller]
    pub fn assert(&self) {
        assert!(self.is_consistent(), "\n{self}");
    }
}

/// The claims that speak against the subject and what it looks like, or one line that says that none does.
impl fmt::Display for Results {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(Outcome { subject, precision, seed, .. }) = self.outcomes.first() else {
            return f.write_str("no claim was tried");
        };
        let (news, all) = (self.news().count(), self.outcomes.len());
        let known = self.outcomes.iter().filter(|outcome| outcome.standing() == Standing::Known).count();
        write!(f, "{subject} in {precision}, suite {}, seed {seed}: ", self.suite.name())?;
        match news {
            0 => write!(f, "nothing in {all} claims speaks against it")?,
            1 => write!(f, "1 of {all} claims speaks against it")?,
            _ => write!(f, "{news} of {all} claims speak against it")?,
        }
        if known > 0 {
            write!(f, "; the paper's own listing fails {known} others too")?;
        }
        for (place, cause) in self.causes.iter().enumerate() {
            write!(f, "\n{}{cause}", if place == 0 { "cause: " } else { "and: " })?;
        }
        for outcome in self.news() {
            write!(f, "\n\n{outcome}")?;
        }
        if news == 0 || !self.causes.is_empty() {
            return Ok(());
        }
        let guesses = diagnosis::guesses(&self.outcomes);
        guesses.iter().take(GUESSES).enumerate().try_for_each(|(place, guess)| {
            let words = if place == 0 { "\n\nlooks like" } else { "\n   or like" };
            write!(f, "{words}: {guess}")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::outcome::tests::outcome;
    use super::super::outcome::{LikeTheListing, Verdict};
    use super::*;
    use crate::threshold::two_scale::Variant;

    fn results(suite: Suite) -> Results {
        let failed_by_the_listing = Outcome {
            variant: Variant::Isotropic,
            listing: Some(LikeTheListing { is_like: true, words: "as much".into() }),
            ..outcome("range.degenerate", Verdict::Rejected)
        };
        Results::new(vec![outcome("range", Verdict::Consistent), failed_by_the_listing], suite)
    }

    #[test]
    fn what_the_listing_fails_is_no_news_to_the_suite_of_the_paper() {
        results(Suite::Paper).assert();
        assert!(!results(Suite::All).is_consistent());
        let text = results(Suite::Paper).to_string();
        let expected = "s in f32, suite paper, seed 0: nothing in 2 claims speaks against it; \
                        the paper's own listing fails 1 others too";
        assert_eq!(text, expected);
    }

    #[test]
    fn a_rejected_subject_is_told_what_it_looks_like() {
        let results = Results::new(diagnosis::tests::outcomes_of("dfdx-twice"), Suite::All);
        let panic = std::panic::catch_unwind(|| results.assert()).expect_err("it is rejected");
        let message = panic.downcast_ref::<String>().expect("a message");
        assert!(
            message.contains(
                "\n\nlooks like: dfdx-twice (the derivative along screen x stands in for the one along y"
            ),
            "{message}"
        );
        assert!(message.contains(") - take dFdy for the second derivative"), "{message}");
    }

    #[test]
    #[should_panic(expected = "rejected: range.degenerate (§5)")]
    fn a_rejection_panics_with_its_name() {
        results(Suite::All).assert();
    }
}
