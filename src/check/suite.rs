//! A run: every claim on every subject, one family of tests.

use super::claims::{Claim, Conclusion, Trial};
use super::tolerance::FAMILY_LEVEL;
use super::{Outcome, Subject, Verdict};
use crate::stats::multiplicity;
use rayon::prelude::*;

/// Tries each claim on each subject and judges them together, at a family-wise level of 1e-6 (Holm).
///
/// [`claims::ALL`](super::claims::ALL) holds every claim.
/// `finished` is called once for every claim and subject, from several threads, in no particular order. The outcomes
/// come subject by subject, claims in the order given; they depend on `seed`, not on the number of
/// threads.
#[must_use]
pub fn run(
    claims: &[Claim],
    subjects: &[Subject<'_>],
    seed: u64,
    finished: impl Fn() + Sync,
) -> Vec<Outcome> {
    let work: Vec<(&Subject<'_>, &Claim)> =
        subjects.iter().flat_map(|subject| claims.iter().map(move |claim| (subject, claim))).collect();
    let trials: Vec<Trial> = work
        .par_iter()
        .with_max_len(1)
        .map(|(subject, claim)| {
            let trial = (claim.run)(subject, seed).unwrap_or_else(|ended| *ended);
            finished();
            trial
        })
        .collect();
    judged(&work, trials, seed)
}

fn judged(work: &[(&Subject<'_>, &Claim)], trials: Vec<Trial>, seed: u64) -> Vec<Outcome> {
    let probability = |trial: &Trial| match trial.conclusion {
        Conclusion::Probability(p) => Some(p),
        _ => None,
    };
    let mut corrected =
        multiplicity::holm(&trials.iter().filter_map(probability).collect::<Vec<_>>()).into_iter();
    work.iter()
        .zip(trials)
        .map(|((subject, claim), trial)| {
            let p = probability(&trial);
            let p_holm = p.and_then(|_| corrected.next());
            let verdict = match trial.conclusion {
                Conclusion::Exact { holds: true } => Verdict::Consistent,
                Conclusion::Exact { holds: false } => Verdict::Rejected,
                Conclusion::Probability(_) if p_holm < Some(FAMILY_LEVEL) => Verdict::Rejected,
                Conclusion::Probability(_) => Verdict::Consistent,
                Conclusion::Inconclusive => Verdict::Inconclusive,
                Conclusion::NotApplicable => Verdict::NotApplicable,
            };
            Outcome {
                check: claim.id,
                anchor: claim.anchor,
                statement: claim.statement,
                subject: subject.name.clone(),
                precision: subject.precision.name(),
                verdict,
                expected: claim.expected,
                statistic: trial.statistic,
                statistic_name: trial.statistic_name,
                n: trial.n,
                p,
                p_holm,
                effect: trial.effect,
                effect_name: trial.effect_name,
                detectable: trial.detectable,
                seed,
                finding: (verdict != Verdict::Consistent).then_some(trial.seen),
                known: None,
                evidence: trial.evidence,
            }
        })
        .collect()
}
