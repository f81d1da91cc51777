//! The battery on the ideal source, once for each of many keys and seeds: no run rejects anything, and the p-values of
//! every claim are what they say.
//!
//! Six runs at [`Budget::Quick`]; `HASHED_ALPHA_BUDGET=nightly` makes it a thousand, `quick` three, and
//! `HASHED_ALPHA_RUNS` any other number. Of every 25 runs one is repeated with the inputs of round 1, of 50 one with those of
//! round 2, of 100 one at [`Budget::Nightly`]: each has a table of its own. With `HASHED_ALPHA_BLESS=all` the table goes to `docs/calibration.md`, as it is
//! after every few runs. With `HASHED_ALPHA_RESUME=FILE` the p-values go to a file as well, and runs that it has are not
//! run again: a thousand take hours.

use crate::budget::budget;
use hashed_alpha::check::specimen::ideal;
use hashed_alpha::check::subject::Precision;
use hashed_alpha::check::{
    Budget, Claim, Conclusion, Draw, Frames, Standing, Subject, Verdict, claims, run_claims,
};
use hashed_alpha::check::{run::SUSPICION, tolerance::FAMILY_LEVEL};
use hashed_alpha::stats::sequential::{self, Decision};
use hashed_alpha::stats::{binomial, ecdf};
use hashed_alpha::threshold::robust::Join;
use hashed_alpha::threshold::two_scale::Variant;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::io::Write as _;
use std::num::NonZeroU32;
use std::path::Path;

/// What the p-values of a claim are on a sound source.
#[derive(Clone, Copy, PartialEq)]
enum Law {
    /// That of one continuous statistic: uniform in both directions.
    Uniform,
    /// The least of several (Bonferroni), or that of a count: larger than uniform, but small in a share of runs.
    Larger,
    /// A bound, with the reason: on a sound source it may be near 1 in every run.
    Bound(&'static str),
}

/// Why the p-values of claims about the whole domain are bounds.
const PARTS: &str =
    "the worst of hundreds of parts of the domain that share samples, most of them judged by an inequality";

/// Claims whose p-values are no [`Law::Larger`].
const LAWS: [(&str, Law); 17] = [
    ("uniform.marginal", Law::Uniform),
    ("uniform.constant_x", Law::Uniform),
    ("uniform.constant_y", Law::Uniform),
    ("uniform.constant_z", Law::Uniform),
    ("uniform.any_plane", Law::Uniform),
    ("exact.cells", Law::Bound("chance may keep one threshold in 2048, as for the sine hash in f32")),
    (
        "hash.lags",
        Law::Bound("ties of up to 0.02 count for none, and no chance ties this many cells as much"),
    ),
    ("hash.values", Law::Bound("four times as many pairs may meet as on a lattice of 24 bits")),
    ("domain.uniform", Law::Bound(PARTS)),
    ("domain.neighbours", Law::Bound(PARTS)),
    ("domain.layers", Law::Bound(PARTS)),
    ("domain.changes", Law::Bound(PARTS)),
    (
        "cells.origin",
        Law::Bound("the inequality of Dvoretzky, Kiefer, Wolfowitz and Massart for few values, times eight"),
    ),
    (
        "flips.translation",
        Law::Bound("Bennett's inequality, and the worst of many shares of the same thresholds"),
    ),
    ("planes.axis_aligned", Law::Bound("one side, of a count that misses new thresholds near the old ones")),
    ("planes.dyadic", Law::Bound("one side, of a count that misses new thresholds near the old ones")),
    (
        "continuity.octave_boundary",
        Law::Bound("one side, of a count of few switches; where a join is continuous, exact"),
    ),
];

fn law(claim: &str) -> Law {
    LAWS.iter().find(|(known, _)| *known == claim).map_or(Law::Larger, |&(_, law)| law)
}

/// The least share of runs in which a p-value that is no bound is below 1/2: a claim whose p-value is 1 in nearly every run
/// hides what its statistic does.
const ALIVE: f64 = 0.1;

/// The inputs of which p-values make one table.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Setting {
    budget: &'static str,
    round: u32,
    /// One in so many runs has them.
    every: u64,
}

/// From the first round at the smallest budget to the largest inputs.
const SETTINGS: [Setting; 4] = [
    Setting { budget: "quick", round: 0, every: 1 },
    Setting { budget: "quick", round: 1, every: 25 },
    Setting { budget: "quick", round: 2, every: 50 },
    Setting { budget: "nightly", round: 0, every: 100 },
];

impl Setting {
    fn draw(self, seed: u64) -> Draw {
        let budget = Budget::ALL.into_iter().find(|known| known.name() == self.budget);
        Draw { seed, budget: budget.expect("a budget of that name"), round: self.round, ..Draw::default() }
    }
}

/// Runs after which the page is written.
const A_FEW: usize = 4;

/// Chance that the p-values of a sound claim fail either test.
const LEVEL: f64 = 1.0e-4;

/// What is tried in turn: every variant and join that is continuous, in both precisions, static and over frames.
const KINDS: [(Variant, Join); 5] = [
    (Variant::Isotropic, Join::Interpolate),
    (Variant::Isotropic, Join::Copula),
    (Variant::Isotropic, Join::Dithered),
    (Variant::Anisotropic, Join::Copula),
    (Variant::Anisotropic, Join::Dithered),
];

/// One run in three spreads its thresholds over frames, two to nine.
fn subject(run: u64) -> Subject<'static> {
    let (variant, join) = KINDS[run as usize % KINDS.len()];
    let subject = ideal(run, variant, Precision::ALL[run as usize / KINDS.len() % 2], join);
    match NonZeroU32::new(run as u32 / 3 % 8 + 2) {
        Some(frames) if run % 3 == 1 => subject.stratified(frames),
        _ => subject,
    }
}

/// The claims that say nothing about a subject, and rightly so.
fn about_others(subject: &Subject<'_>) -> Vec<&'static str> {
    let mut claims = Vec::new();
    if subject.join != Join::Interpolate {
        // Eq. 2 belongs to the paper's join.
        claims.extend(["exact.cdf", "uniform.without_cdf"]);
    }
    // No cell here inherits.
    claims.extend(["nested.children", "nested.kept", "nested.order"]);
    // Nothing here goes through a sequence.
    claims.push("frames.sequence");
    if subject.frames == Frames::Static {
        claims.extend(["frames.stratified", "frames.average"]);
    }
    if subject.join == Join::Dithered {
        // A turn lets a scale pass the same place more than once.
        claims.push("continuity.rotation");
        if subject.variant == Variant::Anisotropic {
            // It draws one octave for a slab of cells.
            claims.push("flips.cluster");
        }
    }
    claims
}

/// The p-values of one round of one run; those of a rejection, and of what is no number, in words.
fn battery(setting: Setting, run: u64) -> Result<Vec<(&'static str, f64)>, String> {
    let (subject, draw) = (subject(run), setting.draw(run));
    let mut found = Vec::new();
    let about_others = about_others(&subject);
    for claim in claims::ALL.iter().filter(|claim| claim.expected == Verdict::Consistent) {
        let trial = (claim.run)(&subject, &draw).unwrap_or_else(|ended| *ended);
        match trial.conclusion {
            Conclusion::Probability(p) => found.push((claim.id, p)),
            Conclusion::Exact { holds: true } => {}
            Conclusion::NotApplicable if about_others.contains(&claim.id) => {}
            _ => return Err(format!("run {run}: {} of {}: {}", claim.id, subject.name, trial.seen)),
        }
    }
    let p: Vec<f64> = found.iter().map(|&(_, p)| p).collect();
    let judged = sequential::judge(&p, 0, FAMILY_LEVEL, SUSPICION);
    if setting.round == 0 && judged.iter().any(|judgement| judgement.decision != Decision::Cleared) {
        retried(run, &subject, &draw)?;
    }
    Ok(found)
}

/// Tries all claims again as a run does, which asks suspect ones for more.
fn retried(run: u64, subject: &Subject<'_>, draw: &Draw) -> Result<(), String> {
    let outcomes = run_claims(claims::ALL, core::slice::from_ref(subject), draw, || {});
    match outcomes
        .iter()
        .find(|outcome| outcome.verdict == Verdict::Rejected && outcome.standing() == Standing::Against)
    {
        Some(outcome) => Err(format!("run {run}: {outcome}")),
        None => Ok(()),
    }
}

/// How the p-values of one claim compare with the uniform law.
struct Calibration {
    claim: &'static str,
    runs: u64,
    least: f64,
    /// P-values below 1e-3, and the probability of so many.
    small: u64,
    p_of_small: f64,
    /// P-values below 1/2, and the probability of so few where a share of [`ALIVE`] is expected.
    below_half: u64,
    p_of_below_half: f64,
    /// The largest excess of their distribution function over the uniform one, or the distance in both directions.
    distance: f64,
    /// What the distance must not reach.
    most: f64,
}

fn calibration(claim: &'static str, mut p: Vec<f64>) -> Calibration {
    p.sort_by(f64::total_cmp);
    let n = p.len() as f64;
    let above = p.iter().enumerate().map(|(i, &p)| (i + 1) as f64 / n - p).fold(0.0, f64::max);
    let below = p.iter().enumerate().map(|(i, &p)| p - i as f64 / n).fold(0.0, f64::max);
    let both = law(claim) == Law::Uniform;
    let below_half = p.iter().filter(|&&p| p < 0.5).count() as u64;
    let small = p.iter().filter(|&&p| p < 1.0e-3).count() as u64;
    Calibration {
        claim,
        runs: p.len() as u64,
        least: p[0],
        small,
        p_of_small: binomial::poisson_upper_p(small, 1.0e-3 * n),
        below_half,
        p_of_below_half: binomial::lower_p(below_half, p.len() as u64, ALIVE),
        distance: if both { above.max(below) } else { above },
        // The bound of Dvoretzky, Kiefer, Wolfowitz and Massart, in both directions or one.
        most: ecdf::dkwm_distance(p.len() as u64, if both { LEVEL } else { 2.0 * LEVEL }),
    }
}

impl Calibration {
    fn holds(&self) -> bool {
        let is_alive = matches!(law(self.claim), Law::Bound(_)) || self.p_of_below_half > LEVEL;
        self.distance < self.most && self.p_of_small > LEVEL && is_alive
    }

    fn row(&self) -> String {
        let law = match law(self.claim) {
            Law::Uniform => "uniform",
            Law::Larger => "uniform or larger",
            Law::Bound(_) => "a bound",
        };
        format!(
            "| {} | {law} | {} | {:.1e} | {} | {:.0} % | {:.4} | {:.4} |",
            self.claim,
            self.runs,
            self.least,
            self.small,
            100.0 * self.below_half as f64 / self.runs as f64,
            self.distance,
            self.most
        )
    }
}

fn page(runs: usize, tables: &BTreeMap<Setting, Vec<Calibration>>) -> String {
    let mut page = format!(
        "# Calibration\n\n\
         The whole battery on the ideal source (SipHash-2-4), {runs} runs with a key and a seed each, in turn over isotropic \
         and\nanisotropic, over every join that is continuous, over `f32` and `f64`, static and spread over frames. No run \
         rejected\nanything, and no claim was left without an answer that could have one. Written by\n\
         `HASHED_ALPHA_RUNS={runs} HASHED_ALPHA_BLESS=all cargo test --test main calibration::`.\n\n\
         A p-value that is the least of several (Bonferroni) or that of a count may be larger than uniform, never \
         smaller;\nthe distance is then the excess of their distribution function over the uniform one. It has to be small \
         in some runs\nall the same. A distance that must stay below 1 or more is no test: there are too few runs, and all that is \
         said is\nthat none of them rejected anything. Some p-values are bounds, and say little on a sound source:\n\n"
    );
    for (claim, law) in LAWS {
        if let Law::Bound(reason) = law {
            writeln!(page, "* `{claim}`: {reason}").expect("writing into memory cannot fail");
        }
    }
    for (setting, table) in tables {
        let Setting { budget, round, .. } = setting;
        write!(
            page,
            "\n## Budget `{budget}`, round {round}\n\n\
             | claim | p-values are | runs | least | below 1e-3 | below 1/2 | distance | must stay below |\n\
             |---|---|---|---|---|---|---|---|\n"
        )
        .expect("writing into memory cannot fail");
        for calibration in table {
            writeln!(page, "{}", calibration.row()).expect("writing into memory cannot fail");
        }
    }
    page
}

/// The p-values of each setting and run.
type Runs = BTreeMap<(Setting, u64), Vec<(&'static str, f64)>>;

/// Reads what [`note`] wrote; nothing where there is no such file.
fn earlier(file: &Path) -> Runs {
    let mut runs = Runs::new();
    for line in std::fs::read_to_string(file).unwrap_or_default().lines() {
        let words: Vec<&str> = line.split(' ').collect();
        let [budget, round, run, claim, p] = words[..] else { panic!("{}: {line}", file.display()) };
        let round: u32 = round.parse().expect("a round");
        let is_it = |setting: &Setting| setting.budget == budget && setting.round == round;
        let setting = SETTINGS.into_iter().find(is_it).expect("a setting that there is");
        let claim = claims::ALL.iter().find(|known| known.id == claim).expect("a claim that there is").id;
        let run = runs.entry((setting, run.parse().expect("a run"))).or_default();
        run.push((claim, p.parse().expect("a p-value")));
    }
    runs
}

/// Adds a line for each p-value of a run.
fn note(file: &Path, (setting, run): (Setting, u64), found: &[(&str, f64)]) {
    let Setting { budget, round, .. } = setting;
    let lines: String =
        found.iter().map(|(claim, p)| format!("{budget} {round} {run} {claim} {p:?}\n")).collect();
    let mut file = std::fs::File::options().create(true).append(true).open(file).expect("a file for notes");
    file.write_all(lines.as_bytes()).expect("room for the notes");
}

#[test]
fn an_ideal_source_is_never_rejected_and_its_p_values_are_true() {
    let asked = std::env::var("HASHED_ALPHA_RUNS").ok();
    let runs: u64 = asked.map_or(budget().pick(3, 6, 1000), |runs| runs.parse().expect("a number of runs"));
    // The small ones first: a page of them is there while the others run.
    let work: Vec<(Setting, u64)> = SETTINGS
        .into_iter()
        .flat_map(|setting| (0..runs).map(move |run| (setting, run)))
        .filter(|(setting, run)| run % setting.every == setting.every - 1)
        .collect();
    let notes = std::env::var_os("HASHED_ALPHA_RESUME");
    let noted = notes.as_ref().map_or_else(Runs::new, |file| earlier(Path::new(file)));
    let (mut tables, mut done) = (BTreeMap::new(), 0);
    let mut by_setting: BTreeMap<Setting, BTreeMap<&str, Vec<f64>>> = BTreeMap::new();
    for some in work.chunks(A_FEW) {
        let fresh = |&(setting, run): &(Setting, u64)| {
            noted.get(&(setting, run)).map_or_else(|| battery(setting, run), |found| Ok(found.clone()))
        };
        let found: Vec<_> = some.par_iter().with_max_len(1).map(fresh).collect();
        let rejected: Vec<&String> = found.iter().filter_map(|run| run.as_ref().err()).collect();
        assert!(rejected.is_empty(), "{rejected:#?}");
        for (&at, found) in some.iter().zip(found.into_iter().flatten()) {
            if let Some(file) = notes.as_ref().filter(|_| !noted.contains_key(&at)) {
                note(Path::new(file), at, &found);
            }
            let by_claim = by_setting.entry(at.0).or_default();
            found.into_iter().for_each(|(claim, p)| by_claim.entry(claim).or_default().push(p));
            done += usize::from(at.0 == SETTINGS[0]);
        }
        tables = by_setting
            .iter()
            .map(|(&setting, by_claim)| {
                let in_order = |claim: &Claim| Some(calibration(claim.id, by_claim.get(claim.id)?.clone()));
                (setting, claims::ALL.iter().filter_map(in_order).collect::<Vec<Calibration>>())
            })
            .collect();
        if std::env::var_os("HASHED_ALPHA_BLESS").is_some() {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/calibration.md");
            std::fs::write(path, page(done, &tables)).expect("the page can be written");
        }
    }
    assert!(tables.values().all(|table| table.len() > 20), "most claims give a probability");
    let all = tables.values().flatten();
    let failed: Vec<String> = all.filter(|claim| !claim.holds()).map(Calibration::row).collect();
    assert!(failed.is_empty(), "{failed:#?}");
}
