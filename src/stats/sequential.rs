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
pub enum Finding {
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
    pub finding: Finding,
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
            let finding = if p_holm <= alpha * WEIGHTS[round] {
                Finding::Rejected
            } else if p_holm <= suspicion && !is_last {
                Finding::Suspect
            } else {
                Finding::Cleared
            };
            Judgement { p_holm, finding }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::seed::{rng, uniform01};
    use super::super::{binomial, normal};
    use super::*;
    use rand::Rng;

    fn findings(p: &[f64], round: usize) -> Vec<Finding> {
        judge(p, round, 1e-6, 1e-2).iter().map(|judgement| judgement.finding).collect()
    }

    #[test]
    fn a_round_rejects_suspects_and_clears() {
        use Finding::{Cleared, Rejected, Suspect};
        let p = [1e-7, 0.5, 1e-3, 2e-7];
        assert_eq!(findings(&p, 0), [Rejected, Cleared, Suspect, Suspect]);
        assert_eq!(findings(&p[2..], 1), [Suspect, Suspect]);
        assert_eq!(findings(&p[2..], 2), [Cleared, Cleared]);
        assert_eq!(judge(&p, 0, 1e-6, 1e-2)[3].p_holm, 3.0 * 2e-7);
        assert!(findings(&[], 1).is_empty());
    }

    #[test]
    fn the_weights_share_out_the_whole_level() {
        assert_eq!(WEIGHTS.iter().sum::<f64>(), 1.0);
    }

    /// Runs the rounds. `data` gives the p-value of a hypothesis in a round; tells what was rejected.
    fn rejected(
        hypotheses: usize,
        alpha: f64,
        suspicion: f64,
        mut data: impl FnMut(usize, usize) -> f64,
    ) -> Vec<usize> {
        let (mut open, mut rejected): (Vec<usize>, Vec<usize>) = ((0..hypotheses).collect(), Vec::new());
        for round in 0..WEIGHTS.len() {
            let p: Vec<f64> = open.iter().map(|&i| data(i, round)).collect();
            let judged = judge(&p, round, alpha, suspicion);
            let those = |finding| {
                open.iter().zip(&judged).filter(move |(_, j)| j.finding == finding).map(|(&i, _)| i)
            };
            rejected.extend(those(Finding::Rejected));
            open = those(Finding::Suspect).collect();
        }
        rejected
    }

    /// One p-value of a normal score with the given mean.
    fn p_of_score(mean: f64, rng: &mut impl Rng) -> f64 {
        normal::upper_p(mean + normal::quantile(uniform01(rng).max(1e-300)))
    }

    /// 20 true and 5 false hypotheses, level .2, suspicion .9 so that much is retested. The bound is met, and
    /// not by far: some .127 of the runs reject a true hypothesis.
    #[test]
    fn the_overall_level_is_kept() {
        let (runs, alpha) = (20_000, 0.2);
        let mut rng = rng("stats.sequential.level", 0);
        let false_alarms = (0..runs)
            .filter(|_| {
                let found = rejected(25, alpha, 0.9, |i, round| {
                    let mean = if i < 20 { 0.0 } else { 2.0 * f64::from(1 << round) };
                    p_of_score(mean, &mut rng)
                });
                found.iter().any(|&i| i < 20)
            })
            .count() as u64;
        let (low, high) = binomial::clopper_pearson(false_alarms, runs, 1e-6);
        assert!(low <= alpha && high > 0.1, "{false_alarms} of {runs}");
    }

    /// The specimen: old data are judged again among fewer hypotheses.
    #[test]
    fn data_that_are_not_fresh_break_the_level() {
        let (runs, alpha) = (20_000, 0.2);
        let mut rng = rng("stats.sequential.stale", 0);
        let false_alarms = (0..runs)
            .filter(|_| {
                let stale: Vec<f64> = (0..20).map(|_| uniform01(&mut rng)).collect();
                !rejected(20, alpha, 0.9, |i, _| stale[i]).is_empty()
            })
            .count() as u64;
        assert!(binomial::clopper_pearson(false_alarms, runs, 1e-6).0 > alpha, "{false_alarms} of {runs}");
    }

    /// A defect of 4.5 standard errors among 300 hypotheses at level 1e-6. One round of the whole level sees
    /// it when its score exceeds 5.80, with probability .10; the rounds when it is suspect, from a score of
    /// 3.99 on, with probability .70, for the next round hardly misses what is then at 9.
    #[test]
    fn what_one_round_nearly_saw_is_found() {
        let (runs, hypotheses, alpha, suspicion, mean) = (500, 300, 1e-6, 1e-2, 4.5);
        let mut rng = rng("stats.sequential.power", 0);
        let (mut at_once, mut in_the_end) = (0, 0);
        for _ in 0..runs {
            let mut first = 1.0;
            let found = rejected(hypotheses, alpha, suspicion, |i, round| {
                let mean = if i == 0 { mean * f64::from(1 << round) } else { 0.0 };
                let p = p_of_score(mean, &mut rng);
                if (i, round) == (0, 0) {
                    first = p;
                }
                p
            });
            at_once += u64::from(hypotheses as f64 * first <= alpha);
            in_the_end += u64::from(found.contains(&0));
        }
        for (seen, level) in [(at_once, alpha), (in_the_end, suspicion)] {
            let predicted = normal::upper_p(-normal::quantile(level / hypotheses as f64) - mean);
            let (low, high) = binomial::clopper_pearson(seen, runs, 1e-6);
            assert!(low < predicted && predicted < high, "{seen} of {runs}, predicted {predicted}");
        }
    }
}
