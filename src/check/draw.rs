//! How the inputs of a run are drawn: by rule, from the seed and the claim's name, and as many as the budget allows.

use crate::stats::seed;
use rand::rngs::Xoshiro256PlusPlus;

/// How many times more samples a retest draws: a shift shows twice as clearly.
const ROUND_GROWTH: usize = crate::stats::sequential::GROWTH;

/// Most samples of one kind in memory, whatever budget and round: a few gigabytes.
const SAMPLES_LIMIT: usize = 1 << 23;

/// How much a run may cost. The size of every sample is stated for [`Budget::Ci`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Budget {
    /// A quarter of the samples: while one works on a shader.
    Quick,
    /// Some tens of seconds a subject on two cores: for every change.
    #[default]
    Ci,
    /// Sixteen times the samples: once a day, or before a release.
    Nightly,
}

impl Budget {
    /// All budgets, the smallest first.
    pub const ALL: [Self; 3] = [Self::Quick, Self::Ci, Self::Nightly];

    /// The word by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Quick => "quick",
            Self::Ci => "ci",
            Self::Nightly => "nightly",
        }
    }
}

/// How far a threshold is asked to hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reach {
    /// In the whole domain.
    #[default]
    Whole,
    /// Where the listings hold as they stand: derivatives above zero along every axis, and cells whose indices their sines tell
    /// apart, below 2^19.
    Listings,
}

/// What fixes the inputs of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Draw {
    /// Seed of every random number.
    pub seed: u64,
    /// How much the run may cost.
    pub budget: Budget,
    /// 0 for the first try; a claim that is suspect is tried again in rounds 1 and 2, with inputs of their own.
    pub round: u32,
    /// How far a threshold is asked to hold.
    pub reach: Reach,
}

impl Draw {
    /// The draw of a seed at the usual budget.
    #[must_use]
    pub fn seeded(seed: u64) -> Self {
        Self { seed, ..Self::default() }
    }

    /// Makes the generator that belongs to a claim in this round.
    #[must_use]
    pub fn rng(&self, claim: &str) -> Xoshiro256PlusPlus {
        match self.round {
            0 => seed::rng(claim, self.seed),
            round => seed::rng(&format!("{claim}, round {round}"), self.seed),
        }
    }

    /// Returns the number of samples to draw where [`Budget::Ci`] draws `at_ci` in its first round.
    #[must_use]
    pub fn samples(&self, at_ci: usize) -> usize {
        let grown = at_ci.saturating_mul(ROUND_GROWTH.pow(self.round));
        match self.budget {
            Budget::Quick => grown / 4,
            Budget::Ci => grown,
            Budget::Nightly => grown.saturating_mul(16),
        }
        .clamp(1, SAMPLES_LIMIT.max(at_ci))
    }

    /// The same where fewer samples than at [`Budget::Ci`] would leave too few in a bin.
    #[must_use]
    pub fn samples_at_least(&self, at_ci: usize) -> usize {
        self.samples(at_ci).max(at_ci)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::Rng;

    #[test]
    fn samples_grow_with_budget_and_round() {
        let draw = |budget, round| Draw { budget, round, ..Draw::default() }.samples(1000);
        assert_eq!(Budget::ALL.map(|budget| draw(budget, 0)), [250, 1000, 16_000]);
        assert_eq!([0, 1, 2].map(|round| draw(Budget::Ci, round)), [1000, 4000, 16_000]);
        let most = Draw { budget: Budget::Nightly, round: 2, ..Draw::default() }.samples(1 << 20);
        assert_eq!(most, SAMPLES_LIMIT);
        assert_eq!(Draw { budget: Budget::Quick, ..Draw::default() }.samples_at_least(1000), 1000);
    }

    #[test]
    fn every_round_has_inputs_of_its_own() {
        let first = |round| Draw { round, ..Draw::seeded(3) }.rng("claim").next_u64();
        assert_eq!(first(0), seed::rng("claim", 3).next_u64());
        assert!(first(0) != first(1) && first(1) != first(2));
    }
}
