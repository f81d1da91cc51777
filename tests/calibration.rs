//! The battery on the ideal source, once for each of many keys and seeds: no run rejects anything, and the p-values of
//! every claim are what they say.
//!
//! Six runs at [`Budget::Quick`]; `HASHED_ALPHA_BUDGET=nightly` makes it a thousand, `quick` three, and
//! `HASHED_ALPHA_RUNS` any other number. With `HASHED_ALPHA_BLESS=all` the table goes to `docs/calibration.md`, as it is
//! after every few runs. With `HASHED_ALPHA_RESUME=FILE` the p-values go to a file as well, and runs that it has are not
//! run again: a thousand take hours.

use crate::budget::budget;
use hashed_alpha::check::specimen::ideal;
use hashed_alpha::check::subject::Precision;
use hashed_alpha::check::{Budget, Claim, Conclusion, Draw, Standing, Subject, Verdict, claims, run_claims};
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

/// Claims whose p-value is that of one continuous statistic: uniform in both directions. All others take the least of
/// several p-values (Bonferroni), a bound, or a count, so that their p-values may only be larger than uniform.
const UNIFORM: [&str; 2] = ["uniform.marginal", "uniform.constant_z"];

/// Runs after which the page is written.
const A_FEW: usize = 20;

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
    if subject.frames == 1 {
        claims.extend(["frames.stratified", "frames.average"]);
    }
    if subject.join == Join::Dithered {
        // A turn lets a scale pass the same place more than once.
        claims.push("continuity.rotation");
    }
    claims
}

/// The p-values of the first round of one run; those of a rejection, and of what is no number, in words.
fn battery(run: u64) -> Result<Vec<(&'static str, f64)>, String> {
    let (subject, draw) = (subject(run), Draw { seed: run, budget: Budget::Quick, ..Draw::default() });
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
    if judged.iter().any(|judgement| judgement.decision != Decision::Cleared) {
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
    let both = UNIFORM.contains(&claim);
    let small = p.iter().filter(|&&p| p < 1.0e-3).count() as u64;
    Calibration {
        claim,
        runs: p.len() as u64,
        least: p[0],
        small,
        p_of_small: binomial::poisson_upper_p(small, 1.0e-3 * n),
        distance: if both { above.max(below) } else { above },
        // The bound of Dvoretzky, Kiefer, Wolfowitz and Massart, in both directions or one.
        most: ecdf::dkwm_distance(p.len() as u64, if both { LEVEL } else { 2.0 * LEVEL }),
    }
}

impl Calibration {
    fn holds(&self) -> bool {
        self.distance < self.most && self.p_of_small > LEVEL
    }

    fn row(&self) -> String {
        let law = if UNIFORM.contains(&self.claim) { "uniform" } else { "uniform or larger" };
        format!(
            "| {} | {law} | {} | {:.1e} | {} | {:.4} | {:.4} |",
            self.claim, self.runs, self.least, self.small, self.distance, self.most
        )
    }
}

fn page(runs: usize, table: &[Calibration]) -> String {
    let mut page = format!(
        "# Calibration\n\n\
         The whole battery at the budget `quick` on the ideal source (SipHash-2-4), {runs} runs with a key and a seed \
         each,\nin turn over isotropic and anisotropic, over every join that is continuous, over `f32` and `f64`, static \
         and spread\nover frames. No run rejected anything, and no claim was left without an answer that could have one. Written by `HASHED_ALPHA_RUNS={runs} HASHED_ALPHA_BLESS=all cargo test --test \
         calibration`.\n\n\
         A p-value that is the least of several (Bonferroni), a bound or that of a count may be larger than uniform, \
         never\nsmaller; the distance is then the excess of their distribution function over the uniform one.\n\n\
         | claim | p-values are | runs | least | below 1e-3 | distance | must stay below |\n\
         |---|---|---|---|---|---|---|\n"
    );
    for calibration in table {
        writeln!(page, "{}", calibration.row()).expect("writing into memory cannot fail");
    }
    page
}

/// Reads what [`note`] wrote; nothing where there is no such file.
fn earlier(file: &Path) -> BTreeMap<u64, Vec<(&'static str, f64)>> {
    let mut runs: BTreeMap<u64, Vec<(&'static str, f64)>> = BTreeMap::new();
    for line in std::fs::read_to_string(file).unwrap_or_default().lines() {
        let words: Vec<&str> = line.split(' ').collect();
        let [run, claim, p] = words[..] else { panic!("{}: {line}", file.display()) };
        let claim = claims::ALL.iter().find(|known| known.id == claim).expect("a claim that there is").id;
        runs.entry(run.parse().expect("a run")).or_default().push((claim, p.parse().expect("a p-value")));
    }
    runs
}

/// Adds a line for each p-value of some runs.
fn note<'a>(file: &Path, found: impl Iterator<Item = (u64, &'a str, f64)>) {
    let lines: String = found.map(|(run, claim, p)| format!("{run} {claim} {p:?}\n")).collect();
    let mut file = std::fs::File::options().create(true).append(true).open(file).expect("a file for notes");
    file.write_all(lines.as_bytes()).expect("room for the notes");
}

#[test]
fn an_ideal_source_is_never_rejected_and_its_p_values_are_true() {
    let asked = std::env::var("HASHED_ALPHA_RUNS").ok();
    let runs = asked.map_or(budget().pick(3, 6, 1000), |runs| runs.parse().expect("a number of runs"));
    let numbers: Vec<u64> = (0..runs).collect();
    let notes = std::env::var_os("HASHED_ALPHA_RESUME");
    let noted = notes.as_ref().map_or_else(BTreeMap::new, |file| earlier(Path::new(file)));
    let (mut table, mut done) = (Vec::new(), 0);
    let mut by_claim: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
    for some in numbers.chunks(A_FEW) {
        let fresh = |run: u64| noted.get(&run).map_or_else(|| battery(run), |found| Ok(found.clone()));
        let found: Vec<_> = some.par_iter().with_max_len(1).map(|&run| fresh(run)).collect();
        let rejected: Vec<&String> = found.iter().filter_map(|run| run.as_ref().err()).collect();
        assert!(rejected.is_empty(), "{rejected:#?}");
        let found: Vec<_> = some.iter().zip(found.into_iter().flatten()).collect();
        if let Some(file) = &notes {
            let new = found.iter().filter(|(run, _)| !noted.contains_key(run));
            note(
                Path::new(file),
                new.flat_map(|(run, found)| found.iter().map(move |&(claim, p)| (**run, claim, p))),
            );
        }
        for (claim, p) in found.into_iter().flat_map(|(_, found)| found) {
            by_claim.entry(claim).or_default().push(p);
        }
        done += some.len();
        let in_order = |claim: &Claim| Some(calibration(claim.id, by_claim.get(claim.id)?.clone()));
        table = claims::ALL.iter().filter_map(in_order).collect::<Vec<Calibration>>();
        if std::env::var_os("HASHED_ALPHA_BLESS").is_some() {
            let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/calibration.md");
            std::fs::write(path, page(done, &table)).expect("the page can be written");
        }
    }
    assert!(table.len() > 20, "most claims give a probability");
    let failed: Vec<String> = table.iter().filter(|claim| !claim.holds()).map(Calibration::row).collect();
    assert!(failed.is_empty(), "{failed:#?}");
}
