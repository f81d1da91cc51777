//! A family of tests that may ask again: rejection at one overall level, with fresh data for what is suspect.
//!
//! A single round has to choose: a strict level misses small defects, a loose one raises false alarms. Here a
//! round rejects, clears, or calls suspect; only suspects go to the next round, on fresh inputs and
//! [`GROWTH`] times as many of them.
//!
//! **The overall level.** With `alpha` overall, the probability that any true hypothesis is ever rejected is
//! at most `alpha`:
//!
//! 1. Which hypotheses reach round r depends on the data of the rounds before it. The data of round r are
//!    fresh, hence independent of that choice: given the choice, a p-value of a true hypothesis is still at
//!    most x with probability at most x.
//! 2. So, given the choice, Holm's method at level `alpha * WEIGHTS[r]` rejects a true hypothesis among
//!    those chosen with probability at most `alpha * WEIGHTS[r]`, whatever the dependence between the tests;
//!    and then also without the condition.
//! 3. The weights add up to 1, and the probability of a union is at most the sum.
//!
//! The suspicion level does not enter: it decides what is spent, not what is proved. The proof needs fresh
//! data. To judge the same data again, or old and new data together, breaks it.

use super::multiplicity;

/// Share of the overall level that each round may spend; they add up to 1.
pub const WEIGHTS: [f64; 3] = [0.5, 0.25, 0.25];

/// How many times more samples a round takes than the one before it.
///
/// A defect that makes a chi-square barely suspect then has four times the noncentrality in the next round,
/// and a normal score twice its size.
pub const GROWTH: usize = 4;

/// Tells what a round says about one hypothesis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Decision {
    /// It is false, at the overall level.
    Rejected,
    /// It goes to the next round, on fresh data.
    Suspect,
    /// Nothing speaks against it.
    Cleared,
}

/// Holds the judgement of one hypothesis in one round.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judgement {
    /// The p-value after Holm's correction for the family of this round, in `[0, 1]`. It is compared with
    /// `alpha * WEIGHTS[round]`.
    pub p_holm: f64,
    /// What the round says.
    pub decision: Decision,
}

/// Judges the p-values of one round; the result is in their order.
///
/// `p` holds one p-value in `[0, 1]` for each hypothesis that is still open: all of them in round 0, the
/// suspects of the round before in rounds 1 and 2, each from data of this round alone. `alpha` is the level
/// of the whole procedure, in `(0, 1)`. A hypothesis is rejected if its Holm p-value is at most `alpha *
/// WEIGHTS[round]`, and suspect if it is at most `suspicion`. The last round has no suspects: what it does
/// not reject it clears.
///
/// Not in the paper; the module says why the level holds.
///
/// # Panics
/// If `round` is not below 3, a p-value is NaN or not in `[0, 1]`, or `alpha` is not in `(0, 1)`.
#[must_use]
pub fn judge(p: &[f64], round: usize, alpha: f64, suspicion: f64) -> Vec<Judgement> {
    assert!(round < WEIGHTS.len(), "round {round} of {}", WEIGHTS.len());
    assert!(alpha > 0.0 && alpha < 1.0, "alpha {alpha} is not in (0, 1)");
    let is_last = round + 1 == WEIGHTS.len();
    multiplicity::holm(p)
        .into_iter()
        .map(|p_holm| {
            let decision = if p_holm <= alpha * WEIGHTS[round] {
                Decision::Rejected
            } else if p_holm <= suspicion && !is_last {
                Decision::Suspect
            } else {
                Decision::Cleared
            };
            Judgement { p_holm, decision }
        })
        .collect()
}
