//! A run: claims on subjects, one family of tests.

use super::claim::Claim;
use super::claims;
use super::known::compare_with_the_listing;
use super::results::{Results, Suite};
use super::tolerance::FAMILY_LEVEL;
use super::trial::{Attempt, Conclusion, Trial};
use super::{Budget, Domain, Draw, Outcome, Subject, Verdict};
use crate::stats::sequential::{self, Decision};
use rayon::prelude::*;

/// Corrected p-value up to which a claim is suspect and tried again with fresh inputs: one sound run in a hundred pays
/// for a second try.
pub const SUSPICION: f64 = 1.0e-2;

/// Why a claim says nothing about a bare hash.
const BARE_HASH: &str = "a bare hash has one cell and no more: the claim is about what a threshold makes of two cells, or about what \
                         changes while one looks";

/// Tries every claim on one subject, with seed 0.
///
/// ```
/// use hashed_alpha::check::{self, Budget, Subject, Suite};
/// use hashed_alpha::threshold::{footprint::Footprint, robust::Robust, two_scale::Variant};
///
/// // The function on trial: from a footprint to a threshold.
/// fn my_threshold(footprint: &Footprint<f32>) -> f32 {
///     Robust::new(Variant::Isotropic).threshold(footprint).unwrap_or(1.0)
/// }
///
/// let subject = Subject::of_f32("mine", Variant::Isotropic, my_threshold);
/// # if false {
/// check::run(&subject, Suite::Paper, Budget::Ci).assert();
/// # }
/// ```
#[must_use]
pub fn run(subject: &Subject<'_>, suite: Suite, budget: Budget) -> Results {
    let draw = Draw { budget, reach: suite.reach(), ..Draw::default() };
    let outcomes = run_claims(claims::ALL, core::slice::from_ref(subject), &draw, || {});
    Results::new(outcomes, suite).examined(subject)
}

/// Tries each claim on each subject and judges them together, at a family-wise level of 1e-6.
///
/// A claim that looks suspect without being rejected is tried again, up to twice, with fresh and more inputs; the three
/// rounds share the level ([`sequential`]). `finished` is called once for every claim and subject, from several threads, in no
/// particular order. The outcomes come subject by subject, claims in the order given; they depend on the draw, not on
/// the number of threads.
#[must_use]
pub fn run_claims(
    claims: &[Claim],
    subjects: &[Subject<'_>],
    draw: &Draw,
    finished: impl Fn() + Sync,
) -> Vec<Outcome> {
    let work: Vec<(&Subject<'_>, &Claim)> =
        subjects.iter().flat_map(|subject| claims.iter().map(move |claim| (subject, claim))).collect();
    let mut outcomes: Vec<Option<Outcome>> = vec![None; work.len()];
    let mut open: Vec<usize> = (0..work.len()).collect();
    for round in 0..sequential::WEIGHTS.len() {
        let draw = Draw { round: round as u32, ..*draw };
        let trials: Vec<(Trial, Domain)> = open
            .par_iter()
            .with_max_len(1)
            .map(|&index| {
                let (subject, claim) = work[index];
                let trial = tried(subject, claim, &draw);
                if round == 0 {
                    finished();
                }
                trial
            })
            .collect();
        let p: Vec<f64> = trials.iter().filter_map(|(trial, _)| probability(trial)).collect();
        let mut judged = sequential::judge(&p, round, FAMILY_LEVEL, SUSPICION).into_iter();
        let mut suspect = Vec::new();
        for (index, (trial, domain)) in open.into_iter().zip(trials) {
            let judgement = probability(&trial).and_then(|_| judged.next());
            if judgement.is_some_and(|judgement| judgement.decision == Decision::Suspect) {
                suspect.push(index);
            }
            let (subject, claim) = work[index];
            outcomes[index] = Some(outcome(subject, claim, trial, domain, judgement, &draw));
        }
        open = suspect;
    }
    let mut outcomes: Vec<Outcome> = outcomes.into_iter().flatten().collect();
    for (subject, outcomes) in subjects.iter().zip(outcomes.chunks_mut(claims.len().max(1))) {
        compare_with_the_listing(subject, outcomes, draw.budget);
    }
    outcomes
}

/// Holds one trial, and tells what it sampled.
fn tried(subject: &Subject<'_>, claim: &Claim, draw: &Draw) -> (Trial, Domain) {
    let subject = subject.observed();
    let trial = held(&subject, claim, draw);
    (trial, subject.domain())
}

/// Holds one trial; a subject that could not be run is not asked again.
pub(super) fn held(subject: &Subject<'_>, claim: &Claim, draw: &Draw) -> Trial {
    if subject.bare_hash && claims::is_beyond_a_hash(claim.id) {
        return Trial::without(Conclusion::NotApplicable, BARE_HASH);
    }
    if let Some(reason) = claims::not_of_kin(subject, claim.id) {
        return Trial::without(Conclusion::NotApplicable, reason);
    }
    let unavailable = || subject.failure().map(|reason| Trial::without(Conclusion::Unavailable, reason));
    unavailable().unwrap_or_else(|| {
        let trial: Attempt<Trial> = (claim.run)(subject, draw);
        unavailable().unwrap_or_else(|| trial.unwrap_or_else(|ended| *ended))
    })
}

fn probability(trial: &Trial) -> Option<f64> {
    match trial.conclusion {
        Conclusion::Probability(p) => Some(p),
        Conclusion::Exact { .. }
        | Conclusion::Inconclusive
        | Conclusion::Unavailable
        | Conclusion::NotApplicable => None,
    }
}

fn outcome(
    subject: &Subject<'_>,
    claim: &Claim,
    mut trial: Trial,
    domain: Domain,
    judgement: Option<sequential::Judgement>,
    draw: &Draw,
) -> Outcome {
    let rejected = judgement.is_some_and(|judgement| judgement.decision == Decision::Rejected);
    let mut verdict = match trial.conclusion {
        Conclusion::Exact { holds: true } => Verdict::Consistent,
        Conclusion::Exact { holds: false } => Verdict::Rejected,
        Conclusion::Probability(_) if rejected => Verdict::Rejected,
        Conclusion::Probability(_) => Verdict::Consistent,
        Conclusion::Inconclusive => Verdict::Inconclusive,
        Conclusion::Unavailable => Verdict::Unavailable,
        Conclusion::NotApplicable => Verdict::NotApplicable,
    };
    if verdict == Verdict::Consistent
        && let (Some(promise), Some(detectable)) = (claim.promise, trial.detectable)
    {
        let needed = promise.samples(trial.n, detectable);
        if needed > trial.n {
            verdict = Verdict::Inconclusive;
            let advice = draw.budget.advice(trial.n, needed);
            trial.seen = format!("{} samples are too few; this claim needs {needed}: {advice}", trial.n);
        }
    }
    let p = probability(&trial);
    Outcome {
        check: claim.id,
        anchor: claim.anchor,
        statement: claim.statement,
        subject: subject.name.clone(),
        variant: subject.variant,
        precision: subject.precision,
        verdict,
        expected: claim.expected,
        statistic: trial.statistic,
        statistic_name: trial.statistic_name,
        n: trial.n,
        p,
        p_holm: judgement.map(|judgement| judgement.p_holm),
        rounds: draw.round + 1,
        effect: trial.effect,
        effect_name: trial.effect_name,
        detectable: trial.detectable,
        domain,
        seed: draw.seed,
        seen: (verdict != Verdict::Consistent).then_some(trial.seen),
        known: None,
        listing: None,
        evidence: trial.evidence,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::claim::Promise;
    use crate::check::subject::Precision;
    use crate::threshold::two_scale::Variant;

    fn claim(id: &'static str, run: fn(&Subject<'_>, &Draw) -> Attempt<Trial>) -> Claim {
        Claim { id, anchor: "", statement: "", expected: Verdict::Consistent, promise: None, run }
    }

    /// A trial that says what a test wants.
    fn says(p: f64, n: u64) -> Trial {
        Trial { n, detectable: Some(0.5), ..Trial::without(Conclusion::Probability(p), "seen") }
    }

    fn outcomes(claims: &[Claim]) -> Vec<Outcome> {
        let subject = Subject::of_f32("s", Variant::Isotropic, |_| 0.5);
        run_claims(claims, &[subject], &Draw::default(), || {})
    }

    #[test]
    fn what_is_suspect_is_tried_again_with_fresh_inputs() {
        let chance = claim("chance", |_, draw| Ok(says(if draw.round == 0 { 1e-4 } else { 0.3 }, 1)));
        let defect = claim("defect", |_, draw| Ok(says([1e-4, 1e-5, 1e-12][draw.round as usize], 1)));
        let sound = claim("sound", |_, _| Ok(says(0.6, 1)));
        let found = outcomes(&[chance, defect, sound]);
        assert_eq!([found[0].rounds, found[1].rounds, found[2].rounds], [2, 3, 1]);
        let verdicts: Vec<Verdict> = found.iter().map(|outcome| outcome.verdict).collect();
        assert_eq!(verdicts, [Verdict::Consistent, Verdict::Rejected, Verdict::Consistent]);
        assert_eq!(found[1].p, Some(1e-12));
    }

    #[test]
    fn a_claim_that_cannot_keep_its_promise_has_no_answer() {
        let mut weak = claim("weak", |_, _| Ok(says(0.6, 100)));
        for (promise, needed) in [(Promise::Linear(0.25), 200), (Promise::Root(0.25), 400)] {
            weak.promise = Some(promise);
            let found = outcomes(&[weak]).remove(0);
            assert_eq!(found.verdict, Verdict::Inconclusive);
            let expected =
                format!("100 samples are too few; this claim needs {needed}: --budget nightly draws as many");
            assert_eq!(found.seen, Some(expected));
        }
        // What is seen all the same counts.
        weak.run = |_, _| Ok(says(1e-9, 100));
        assert_eq!(outcomes(&[weak])[0].verdict, Verdict::Rejected);
    }

    #[test]
    fn a_subject_that_breaks_is_unavailable_from_there_on() {
        let asks = claim("asks", |subject, _| {
            let scene = &crate::scene::Scene::all()[0];
            let rng = &mut crate::stats::seed::rng("suite.tests", 0);
            let threshold = subject.threshold(crate::check::input::sample::sighting(scene, rng).fragment);
            Ok(Trial::without(Conclusion::Exact { holds: threshold.is_some() }, "no threshold"))
        });
        let broken =
            Subject::batched("gone", Precision::F32, Variant::Isotropic, |_| Err("device lost".into()));
        for outcome in run_claims(&[asks, asks], &[broken], &Draw::default(), || {}) {
            assert_eq!(outcome.verdict, Verdict::Unavailable);
            assert_eq!(outcome.seen.as_deref(), Some("device lost"));
        }
    }
}
