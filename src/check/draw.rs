//! How the inputs of a run are drawn: by rule, from the seed and the claim's name, and as many as the budget allows.

use crate::stats::seed;
use rand::rngs::Xoshiro256PlusPlus;

/// How many times more samples a retest draws: a shift shows twice as clearly.
const ROUND_GROWTH: usize = crate::stats::sequential::GROWTH;

/// Most samples of one kind in memory, whatever budget and round: a few gigabytes.
const SAMPLES_LIMIT: usize = 1 << 23;

/// Most samples that a claim which needs all of them at once is given when it grows: half a gigabyte a claim, of which each
/// thread tries one.
const HELD_LIMIT: usize = 1 << 21;

/// Most samples of one kind of a claim that goes through them chunk by chunk: the cells that they have used are told apart
/// in a table of 2^31 bits, and the blocks of cells from which claims draw have 2^30 cells.
const STREAM_LIMIT: usize = 1 << 27;

/// Samples of a chunk: as many as a marginal claim draws at [`Budget::Ci`], some fifty megabytes.
const CHUNK: usize = 1 << 18;

/// Most samples of which a grown claim keeps one number each, as to sort them: an eighth of a gigabyte.
pub const KEPT_LIMIT: usize = 1 << 24;

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

    /// How many quarters of the samples of [`Budget::Ci`] it draws.
    const fn quarters(self) -> usize {
        match self {
            Self::Quick => 1,
            Self::Ci => 4,
            Self::Nightly => 64,
        }
    }

    /// Says which budget draws about as many samples as are `needed`, where this one drew `n`.
    pub(super) fn advice(self, n: u64, needed: u64) -> String {
        let drawn = |budget: Self| n.saturating_mul(budget.quarters() as u64) / self.quarters() as u64;
        let enough = Self::ALL.into_iter().find(|&budget| drawn(budget) >= needed);
        enough.map_or_else(
            || "no budget draws as many".to_owned(),
            |budget| format!("--budget {} draws as many", budget.name()),
        )
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
    /// How often the samples of the budget are doubled ([`growth`](super::growth)); 0 in a run that does not grow. Each
    /// doubling has inputs of its own.
    pub doublings: u32,
    /// How far a threshold is asked to hold.
    pub reach: Reach,
}

impl Draw {
    /// The draw of a seed at the usual budget.
    #[must_use]
    pub fn seeded(seed: u64) -> Self {
        Self { seed, ..Self::default() }
    }

    /// Makes the generator that belongs to a claim in this round and after these doublings.
    #[must_use]
    pub fn rng(&self, claim: &str) -> Xoshiro256PlusPlus {
        let round = if self.round > 0 { format!(", round {}", self.round) } else { String::new() };
        let doublings =
            if self.doublings > 0 { format!(", doubled {} times", self.doublings) } else { String::new() };
        seed::rng(&format!("{claim}{round}{doublings}"), self.seed)
    }

    /// Returns the number of samples to draw where [`Budget::Ci`] draws `at_ci` in its first round, for a claim that holds all of
    /// them at once: doubling ends where they would fill the memory.
    #[must_use]
    pub fn samples(&self, at_ci: usize) -> usize {
        self.doubled(self.of_budget(at_ci), HELD_LIMIT)
    }

    /// The same where fewer samples than at [`Budget::Ci`] would leave too few in a bin.
    #[must_use]
    pub fn samples_at_least(&self, at_ci: usize) -> usize {
        self.doubled(self.of_budget(at_ci).max(at_ci), HELD_LIMIT)
    }

    /// Returns the number of samples for a claim that goes through them in [`Draw::chunks`], with no more than a chunk in memory.
    #[must_use]
    pub fn stream(&self, at_ci: usize) -> usize {
        self.doubled(self.of_budget(at_ci), STREAM_LIMIT)
    }

    /// The same where fewer samples than `least` would leave too few in a bin.
    #[must_use]
    pub fn stream_at_least(&self, at_ci: usize, least: usize) -> usize {
        self.doubled(self.of_budget(at_ci).max(least), STREAM_LIMIT)
    }

    /// Returns how many groups of equal size a claim tries, which grows by more groups: `at_first` of them before doubling.
    #[must_use]
    pub fn groups(&self, at_first: usize) -> usize {
        self.doubled(at_first, STREAM_LIMIT)
    }

    /// The same draw without doubling: what fixes the size of a group where their number grows.
    #[must_use]
    pub fn of_a_group(&self) -> Self {
        Self { doublings: 0, ..*self }
    }

    /// Cuts a number of samples into the sizes of chunks; one chunk where nothing is doubled, so that a run which does not
    /// grow judges all its samples at once.
    pub fn chunks(&self, samples: usize) -> impl Iterator<Item = usize> + use<> {
        let size = if self.doublings == 0 { samples.max(1) } else { CHUNK };
        (0..samples).step_by(size).map(move |first| size.min(samples - first))
    }

    /// The number of samples that budget and round ask for.
    fn of_budget(&self, at_ci: usize) -> usize {
        let grown = at_ci.saturating_mul(ROUND_GROWTH.pow(self.round));
        let quarters = grown.saturating_mul(self.budget.quarters());
        (quarters / 4).clamp(1, SAMPLES_LIMIT.max(at_ci))
    }

    /// Doubles a number up to a limit; one that is above the limit already stays.
    fn doubled(&self, samples: usize, limit: usize) -> usize {
        let doubled = samples.saturating_mul(1_usize.checked_shl(self.doublings).unwrap_or(usize::MAX));
        doubled.min(limit.max(samples))
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

    #[test]
    fn samples_double_up_to_what_memory_and_cells_allow() {
        let draw = |doublings| Draw { doublings, ..Draw::default() };
        assert_eq!([0, 1, 10].map(|k| draw(k).samples(1000)), [1000, 2000, 1_024_000]);
        assert_eq!([20, 63, 64, 99].map(|k| draw(k).samples(1000)), [HELD_LIMIT; 4]);
        assert_eq!(draw(30).stream(1000), STREAM_LIMIT);
        assert_eq!(draw(3).groups(8), 64);
        // What is above the limit at first stays as it is.
        let nightly = Draw { budget: Budget::Nightly, ..draw(5) };
        assert_eq!(nightly.samples(1 << 18), 1 << 22);
        let quick = Draw { budget: Budget::Quick, ..draw(2) };
        assert_eq!((quick.stream(1000), quick.stream_at_least(1000, 500)), (1000, 2000));
    }

    #[test]
    fn chunks_add_up_and_are_one_where_nothing_grows() {
        let sizes = |doublings, samples| -> Vec<usize> {
            Draw { doublings, ..Draw::default() }.chunks(samples).collect()
        };
        assert_eq!(sizes(0, 3 * CHUNK), [3 * CHUNK]);
        assert_eq!(sizes(1, 2 * CHUNK + 5), [CHUNK, CHUNK, 5]);
        assert_eq!(sizes(1, CHUNK), [CHUNK]);
        assert!(sizes(0, 0).is_empty() && sizes(1, 0).is_empty());
    }

    #[test]
    fn every_doubling_has_inputs_of_its_own() {
        let first = |doublings| Draw { doublings, ..Draw::seeded(3) }.rng("claim").next_u64();
        assert_eq!(first(0), seed::rng("claim", 3).next_u64());
        assert!(first(0) != first(1) && first(1) != first(2));
    }
}
