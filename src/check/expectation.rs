//! Findings that are known, so that a run can tell them from new ones.

use super::{Outcome, Verdict};

/// A claim that is known to be rejected.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expectation {
    /// Identifier of the claim.
    pub check: String,
    /// Name of the subject.
    pub subject: String,
    /// "f32" or "f64".
    pub precision: String,
}

impl Expectation {
    fn names(&self, outcome: &Outcome) -> bool {
        self.check == outcome.check && self.subject == outcome.subject && self.precision == outcome.precision
    }
}

/// How a run compares with what was known. Indices point into the outcomes, and into the expectations for `stale`
/// and `unmatched`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Judgement {
    /// Outcomes that a sound subject would not give, and that were not known.
    pub unexpected: Vec<usize>,
    /// Outcomes that a sound subject would not give, and that were known.
    pub known: Vec<usize>,
    /// Expectations whose claim ran and was not rejected: the list is out of date.
    pub stale: Vec<usize>,
    /// Expectations that name no claim of this run.
    pub unmatched: Vec<usize>,
}

/// Sorts the outcomes of a run by what was known of them.
#[must_use]
pub fn judge(outcomes: &[Outcome], expectations: &[Expectation]) -> Judgement {
    let mut judgement = Judgement::default();
    for (index, outcome) in outcomes.iter().enumerate().filter(|(_, outcome)| !outcome.as_expected()) {
        let known = outcome.known.is_some()
            || outcome.verdict == Verdict::Rejected && expectations.iter().any(|known| known.names(outcome));
        if known { &mut judgement.known } else { &mut judgement.unexpected }.push(index);
    }
    for (index, expectation) in expectations.iter().enumerate() {
        match outcomes.iter().find(|outcome| expectation.names(outcome)) {
            None => judgement.unmatched.push(index),
            Some(outcome) if outcome.as_expected() => judgement.stale.push(index),
            Some(_) => {}
        }
    }
    judgement
}

#[cfg(test)]
mod tests {
    use super::super::outcome::tests::outcome;
    use super::*;

    fn known(check: &str) -> Expectation {
        Expectation { check: check.into(), subject: "s".into(), precision: "f32".into() }
    }

    #[test]
    fn findings_are_told_from_known_ones() {
        let outcomes = [
            outcome("a", Verdict::Consistent),
            outcome("b", Verdict::Rejected),
            outcome("c", Verdict::Rejected),
            outcome("d", Verdict::Inconclusive),
            outcome("e", Verdict::NotApplicable),
        ];
        let judgement = judge(&outcomes, &[known("b"), known("a"), known("nobody"), known("d")]);
        assert_eq!(judgement.known, [1]);
        assert_eq!(judgement.unexpected, [2, 3]);
        assert_eq!(judgement.stale, [1]);
        assert_eq!(judgement.unmatched, [2]);
    }
}
