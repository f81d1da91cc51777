//! Growth: the samples of every claim are doubled until it fails, or can have no more.
//!
//! A claim on a subject goes through levels. At level k it draws 2^k times the samples of its budget, fresh ones, and is
//! rejected where its p-value is at most the level of the run, times [`share_of_level`], over the number of claims and
//! subjects. The shares of all levels add up to less than one, so by the union bound the probability that any true claim is
//! ever rejected is at most that of the run, **whenever one stops** and whatever one stops for: which levels are tried does
//! not enter. All levels below cost as much as one more of the last, which is the price of not knowing beforehand how many
//! samples it takes. A statement without chance in it counts at any level.
//!
//! Negative controls are left out: a sound subject fails them, and growth shows no more of them.

use super::run::held;
use super::tolerance::FAMILY_LEVEL;
use super::{Claim, Conclusion, Draw, Subject, Verdict};
use crate::scene::{Fragment, Scene};
use core::f64::consts::PI;
use core::hash::Hasher;
use rustc_hash::FxHasher;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// A level that has not this many times the samples of the one before is the last one: the claim goes through a fixed table,
/// or its inputs have no more cells.
const LEAST_GROWTH: f64 = 1.25;

/// Pixels of the images by whose thresholds two subjects of one name are told apart.
const FINGERPRINT_RESOLUTION: [u32; 2] = [24, 18];

/// Returns the share of the level that the k-th doubling may spend: (6 / pi^2) / (k + 1)^2. Over all k they add up to 1.
#[must_use]
pub fn share_of_level(doublings: u32) -> f64 {
    let place = f64::from(doublings) + 1.0;
    6.0 / (PI * PI * place * place)
}

/// What grows: claims on subjects, from a seed and a budget on.
#[derive(Debug)]
pub struct Plan<'a> {
    /// The claims.
    pub claims: Vec<Claim>,
    /// The subjects.
    pub subjects: Vec<Subject<'a>>,
    /// Seed and budget of level 0.
    pub draw: Draw,
    /// The last level, where one is wanted.
    pub most_doublings: Option<u32>,
}

impl<'a> Plan<'a> {
    /// Makes a plan of those of the claims that are no negative controls.
    #[must_use]
    pub fn new(
        claims: &[Claim],
        subjects: Vec<Subject<'a>>,
        draw: Draw,
        most_doublings: Option<u32>,
    ) -> Self {
        let claims = claims.iter().filter(|claim| claim.expected == Verdict::Consistent).copied().collect();
        Self { claims, subjects, draw, most_doublings }
    }

    /// Returns up to which p-value a claim is rejected at a level.
    #[must_use]
    pub fn critical(&self, doublings: u32) -> f64 {
        FAMILY_LEVEL * share_of_level(doublings) / (self.claims.len() * self.subjects.len()) as f64
    }

    /// Returns how the course of a claim on a subject has ended, from its steps in the order of their levels; nothing where it
    /// goes on.
    #[must_use]
    pub fn end(&self, steps: &[&Step]) -> Option<End> {
        let last = steps.last()?;
        match last.conclusion {
            Conclusion::NotApplicable => return Some(End::NotApplicable),
            Conclusion::Unavailable => return Some(End::Unavailable),
            Conclusion::Exact { holds: false } => return Some(End::Failed),
            Conclusion::Probability(p) if p <= self.critical(last.doublings) => return Some(End::Failed),
            Conclusion::Probability(_) | Conclusion::Exact { holds: true } | Conclusion::Inconclusive => {}
        }
        let before = steps.len().checked_sub(2).map(|index| steps[index]);
        if before.is_some_and(|before| (last.n as f64) < LEAST_GROWTH * before.n as f64) || last.n == 0 {
            return Some(if steps.len() <= 2 { End::Fixed } else { End::Full });
        }
        self.most_doublings.is_some_and(|most| last.doublings >= most).then_some(End::AsFarAsAsked)
    }
}

/// One level of one claim on one subject.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Index of the claim in the plan.
    pub claim: usize,
    /// Index of the subject in the plan.
    pub subject: usize,
    /// The level: how often the samples have been doubled.
    pub doublings: u32,
    /// What the trial says by itself.
    pub conclusion: Conclusion,
    /// Samples that entered its statistic, of this level alone.
    pub n: u64,
    /// Size of the effect that was seen, in the unit of `effect_name`.
    pub effect: Option<f64>,
    /// What the effect measures.
    pub effect_name: String,
    /// What was seen, in words.
    pub seen: String,
    /// Seconds that the trial took.
    pub seconds: f64,
}

/// How the course of a claim on a subject has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum End {
    /// The claim is rejected.
    Failed,
    /// It holds, and goes through a table that does not grow.
    Fixed,
    /// It holds, and its samples fill the memory that it is given, or its inputs have no more cells.
    Full,
    /// It holds, and no more doublings were asked for.
    AsFarAsAsked,
    /// It says nothing about the subject.
    NotApplicable,
    /// The subject could not be run.
    Unavailable,
}

/// Lets every claim of a plan grow, on all threads, and hands over each step when it is done; `known` are the steps of an
/// earlier run of the same plan, which are not taken again.
///
/// Whoever has taken the least time goes next, so that all have about the same time. What a step sees depends on the plan
/// alone, not on that order. Between two steps `stopped` is asked whether to end early.
pub fn grow(
    plan: &Plan<'_>,
    known: &[Step],
    stopped: impl Fn() -> bool + Sync,
    finished: impl Fn(Step) + Sync,
) {
    let mut open: Vec<Job> = Vec::new();
    for subject in 0..plan.subjects.len() {
        for claim in 0..plan.claims.len() {
            let steps: Vec<Step> = course(known, subject, claim).into_iter().cloned().collect();
            open.extend(Job::after(plan, subject, claim, steps));
        }
    }
    // Taken from the end: the least costly last, and of equal ones the first.
    let by_cost = |open: &mut Vec<Job>| {
        open.sort_by(|a, b| {
            b.cost().total_cmp(&a.cost()).then((b.subject, b.claim).cmp(&(a.subject, a.claim)))
        });
    };
    by_cost(&mut open);
    let open = Mutex::new(open);
    let lock = || open.lock().unwrap_or_else(PoisonError::into_inner);
    // A worker without a job may leave: each job that ends makes at most one, which its own worker takes.
    rayon::broadcast(|_| {
        while !stopped() {
            let Some(mut job) = lock().pop() else { break };
            let step = job.step(plan);
            finished(step.clone());
            job.steps.push(step);
            if let Some(next) = Job::after(plan, job.subject, job.claim, job.steps) {
                let mut open = lock();
                open.push(next);
                by_cost(&mut open);
            }
        }
    });
}

/// Returns the steps of a claim on a subject by their levels, from 0 on without a gap.
#[must_use]
pub fn course(steps: &[Step], subject: usize, claim: usize) -> Vec<&Step> {
    let mut found: Vec<&Step> =
        steps.iter().filter(|step| (step.subject, step.claim) == (subject, claim)).collect();
    found.sort_by_key(|step| step.doublings);
    let whole = found.iter().zip(0..).take_while(|(step, level)| step.doublings == *level).count();
    found.truncate(whole);
    found
}

/// The next step of a claim on a subject.
struct Job {
    subject: usize,
    claim: usize,
    steps: Vec<Step>,
}

impl Job {
    /// Returns what follows some steps, if anything does.
    fn after(plan: &Plan<'_>, subject: usize, claim: usize, steps: Vec<Step>) -> Option<Self> {
        plan.end(&steps.iter().collect::<Vec<_>>()).is_none().then_some(Self { subject, claim, steps })
    }

    /// Seconds that it will take, by those of the step before.
    fn cost(&self) -> f64 {
        self.steps.last().map_or(0.0, |step| 2.0 * step.seconds)
    }

    fn step(&mut self, plan: &Plan<'_>) -> Step {
        let doublings = self.steps.len() as u32;
        let draw = Draw { doublings, ..plan.draw };
        let begun = Instant::now();
        let trial = held(&plan.subjects[self.subject], &plan.claims[self.claim], &draw);
        Step {
            claim: self.claim,
            subject: self.subject,
            doublings,
            conclusion: trial.conclusion,
            n: trial.n,
            effect: trial.effect,
            effect_name: trial.effect_name.to_owned(),
            seen: trial.seen,
            seconds: begun.elapsed().as_secs_f64(),
        }
    }
}

/// Describes a subject so that another one, or the same one after a change, can be told from it: what it claims of itself, and
/// a digest of its thresholds on a fixed set of fragments.
#[must_use]
pub fn fingerprint(subject: &Subject<'_>) -> String {
    let mut fragments = Vec::new();
    for scene in Scene::all() {
        fragments.extend(scene.with_resolution(FINGERPRINT_RESOLUTION).fragments().map(|fragment| {
            Fragment { footprint: subject.precision.round(&fragment.footprint), ..fragment }
        }));
    }
    let mut digest = FxHasher::default();
    subject.thresholds(&fragments).into_iter().for_each(|value| digest.write_u64(value.to_bits()));
    let Subject { name, precision, variant, join, nested_phase, hash_scale, frames, bare_hash, .. } = subject;
    format!(
        "{name} in {precision}, {variant}, {}, nested phase {nested_phase}, hash scale {hash_scale}, frames {frames}, bare hash \
         {bare_hash}, digest {:016x}",
        join.name(),
        digest.finish()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::claims;
    use crate::check::subject::Precision;
    use crate::threshold::hash::{Cell, Hash, HashKind};
    use crate::threshold::real::Real;
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// MurmurHash3 with no more than `VALUES` values.
    #[derive(Clone, Copy)]
    struct Few<const VALUES: u32>;

    impl<R: Real, const VALUES: u32> Hash<R> for Few<VALUES> {
        fn hash(&self, cell: &Cell<R>) -> R {
            let value: f64 = HashKind::Mm4.hash(&Cell::<f64> {
                index: {
                    let [x, y, z] = cell.index.into();
                    glam::dvec3(x.to_f64(), y.to_f64(), z.to_f64())
                },
                octave: cell.octave,
            });
            R::from_f64(((value * f64::from(VALUES)).floor() + 0.5) / f64::from(VALUES))
        }
    }

    fn grown(plan: &Plan<'_>, known: &[Step], most: usize) -> Vec<Step> {
        let steps = Mutex::new(known.to_vec());
        let taken = AtomicUsize::new(0);
        grow(
            plan,
            known,
            || taken.load(Ordering::Relaxed) >= most,
            |step| {
                taken.fetch_add(1, Ordering::Relaxed);
                steps.lock().unwrap().push(step);
            },
        );
        let mut steps = steps.into_inner().unwrap();
        steps.sort_by_key(|step| (step.subject, step.claim, step.doublings));
        steps.iter_mut().for_each(|step| step.seconds = 0.0);
        steps
    }

    fn quick() -> Draw {
        Draw { budget: crate::Budget::Quick, ..Draw::default() }
    }

    #[test]
    fn all_levels_together_spend_the_level() {
        let spent: f64 = (0..100_000).map(share_of_level).sum();
        assert!(spent < 1.0 && spent > 0.9999, "{spent}");
        let plan = Plan::new(claims::ALL, Subject::paper(), Draw::default(), None);
        assert!(plan.claims.iter().all(|claim| claim.id != "uniform.without_cdf"));
        let first = plan.critical(0) * (plan.claims.len() * 4) as f64;
        assert!((first / FAMILY_LEVEL - 6.0 / (PI * PI)).abs() < 1e-12);
    }

    #[test]
    fn a_run_that_was_stopped_and_continued_is_one_that_was_not() {
        let claims =
            [claims::hash::VALUES, claims::hash::RESONANCE, claims::cells::ORIGIN, claims::range::RANGE];
        let subject = || vec![Subject::of_hash("few", Precision::F32, Few::<3_000_000>)];
        let plan = Plan::new(&claims, subject(), quick(), Some(2));
        let whole = grown(&plan, &[], usize::MAX);
        let part = grown(&plan, &[], 5);
        assert!(part.len() < whole.len(), "{} of {}", part.len(), whole.len());
        assert_eq!(grown(&plan, &part, usize::MAX), whole);
        let ends: Vec<_> = (0..claims.len()).map(|claim| plan.end(&course(&whole, 0, claim))).collect();
        assert_eq!(ends[2..], [Some(End::Fixed), Some(End::NotApplicable)]);
        assert_eq!(ends[1], Some(End::AsFarAsAsked));
    }

    #[test]
    fn too_few_values_show_at_the_level_that_their_number_says() {
        // Pairs of n cells meet n^2 / 2 times the share: allowed is one in 2^22, and these have one in 2^16 and in 0.9 * 2^22.
        let plan = |hash| Plan::new(&[claims::hash::VALUES], vec![hash], quick(), Some(6));
        let level = |hash| {
            let plan = plan(hash);
            let steps = grown(&plan, &[], usize::MAX);
            assert_eq!(plan.end(&course(&steps, 0, 0)), Some(End::Failed));
            steps.len() - 1
        };
        assert_eq!(level(Subject::of_hash("2^16", Precision::F32, Few::<65_536>)), 0);
        // 2^14 cells and m = 32 expected; an excess of a ninth is 7 standard deviations at m = 4000 to 8000: 3 or 4 doublings.
        let found = level(Subject::of_hash("most", Precision::F64, Few::<3_774_873>));
        assert!((3..=4).contains(&found), "{found}");
    }

    #[test]
    fn a_bare_hash_is_the_hash_of_its_cell() {
        let subject = Subject::of_hash("mm4", Precision::F32, HashKind::Mm4);
        let footprint =
            crate::check::input::at_scale(subject.variant, 1.0, glam::dvec3(5.25, -3.5, 9.75), [0.0; 3]);
        let cell = Cell { index: glam::dvec3(5.0, -4.0, 9.0), octave: 0 };
        assert_eq!(subject.threshold(footprint), Some(HashKind::Mm4.hash(&cell)));
        let other = Subject::of_hash("mm4", Precision::F32, HashKind::Pcg3d);
        assert!(fingerprint(&subject) != fingerprint(&other));
    }
}
