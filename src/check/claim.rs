//! A claim: a sentence about a threshold, and how it is tried.

use crate::check::trial::{Attempt, Trial};
use crate::check::{Draw, Subject, Verdict};

/// A sentence about a threshold, and how it is tried.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// Identifier, `family.claim`.
    pub id: &'static str,
    /// Place in the paper.
    pub anchor: &'static str,
    /// The sentence.
    pub statement: &'static str,
    /// What a sound subject answers: [`Verdict::Rejected`] for a negative control.
    pub expected: Verdict,
    /// The smallest effect that the claim promises to see; absent where a fixed table is gone through.
    pub promise: Option<Promise>,
    /// Tries the claim on a subject with inputs that follow from the identifier and the draw; an error is a trial that
    /// ended before its statistic.
    pub run: fn(&Subject<'_>, &Draw) -> Attempt<Trial>,
}

/// An effect that a claim promises to see with power 0.999, and how what it sees depends on the number of samples.
///
/// A trial that would not have seen it is inconclusive, unless it rejects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Promise {
    /// Twice the samples show half the effect: an excess of chi-square, a share where none is allowed.
    Linear(f64),
    /// Four times the samples show half the effect: a shift, a distance, a correlation.
    Root(f64),
}

impl Promise {
    /// Returns the samples that the promise needs, where `n` samples show an effect of `detectable`.
    #[must_use]
    pub fn samples(self, n: u64, detectable: f64) -> u64 {
        let times = match self {
            Self::Linear(effect) => detectable / effect,
            Self::Root(effect) => (detectable / effect) * (detectable / effect),
        };
        (n as f64 * times).ceil() as u64
    }
}
