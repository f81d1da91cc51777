//! A claim: a sentence about a threshold, and how it is tried.

use crate::check::trial::{Attempt, Trial};
use crate::check::{Draw, Subject, Verdict};

/// A sentence about a threshold, and how it is tried.
///
/// The built-in ones are [`claims::ALL`](super::claims::ALL). One of your own is a constant, too:
///
/// ```
/// use hashed_alpha::check::{Attempt, Claim, Conclusion, Draw, Promise, Trial, Verdict, run_claims};
/// use hashed_alpha::scene::{Fragment, Scene};
/// use hashed_alpha::{Subject, Variant};
///
/// fn above_zero(subject: &Subject<'_>, _: &Draw) -> Attempt<Trial> {
///     let fragments: Vec<Fragment> = Scene::wall().fragments().step_by(1000).collect();
///     let thresholds = subject.thresholds(&fragments);
///     let bad = thresholds.iter().filter(|threshold| !(**threshold > 0.0)).count();
///     Ok(Trial {
///         n: fragments.len() as u64,
///         effect: Some(bad as f64 / fragments.len() as f64),
///         effect_name: "share of fragments",
///         ..Trial::without(Conclusion::Exact { holds: bad == 0 }, format!("{bad} thresholds are not above zero"))
///     })
/// }
///
/// const ABOVE_ZERO: Claim = Claim {
///     id: "mine.above_zero",
///     anchor: "§5",
///     statement: "every threshold on a wall is above zero",
///     expected: Verdict::Consistent,
///     promise: None,
///     run: above_zero,
/// };
///
/// let subject = Subject::of_f32("mine", Variant::Isotropic, |_| 0.0);
/// let outcomes = run_claims(&[ABOVE_ZERO], &[subject], &Draw::default(), || {});
/// assert_eq!(outcomes[0].verdict, Verdict::Rejected);
/// ```
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
