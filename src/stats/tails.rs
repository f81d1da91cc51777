//! Both tails of a statistic.

/// Holds the probabilities of a statistic at least as small, and at least as large, as the one observed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tails {
    /// Probability of a statistic as small or smaller, in `[0, 1]`.
    pub lower: f64,
    /// Probability of a statistic as large or larger, in `[0, 1]`.
    pub upper: f64,
}

impl Tails {
    /// Gives the two-sided p-value: twice the smaller tail, at most 1.
    ///
    /// It also rejects what is too good to be random: a fit that is closer than chance allows.
    #[must_use]
    pub fn two_sided_p(self) -> f64 {
        (2.0 * self.lower.min(self.upper)).min(1.0)
    }
}
