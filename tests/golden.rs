//! Same seed, same bits: the battery on a few subjects, line by line as it was committed, on every machine and with any
//! number of threads.
//!
//! A change of these lines is a change of seeded results and belongs into the changelog;
//! `HASHED_ALPHA_BLESS=all cargo test --test main golden::` writes them anew.

use hashed_alpha::check::evidence::{ComparedShare, Evidence};
use hashed_alpha::check::specimen::{self, ideal};
use hashed_alpha::check::subject::Precision;
use hashed_alpha::check::{
    Budget, Comparison, Draw, Outcome, Reach, Subject, claims, compare, coordinates, diagnosis, run_claims,
};
use hashed_alpha::threshold::robust::Join;
use hashed_alpha::threshold::two_scale::Variant;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Not the draw of the kill matrix.
const DRAW: Draw = Draw { seed: 7, budget: Budget::Quick, round: 0, doublings: 0, reach: Reach::Whole };

fn path() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/battery.txt")
}

/// What is sound and what is not.
fn subjects() -> Vec<Subject<'static>> {
    let sound = ideal(1, Variant::Anisotropic, Precision::F32, Join::Dithered);
    let kept = |subjects: Vec<Subject<'static>>, name: &str, precision: Precision| {
        subjects.into_iter().find(|subject| subject.name == name && subject.precision == precision)
    };
    let robust = kept(Subject::all_repairs(), "robust:isotropic", Precision::F64);
    let copula = kept(Subject::all_repairs(), "robust:anisotropic", Precision::F32);
    let paper = kept(Subject::paper(), "paper:anisotropic", Precision::F32);
    [Some(sound), robust, copula, paper].into_iter().flatten().collect()
}

/// The first digits of a digest.
fn digest(all: &str) -> String {
    Sha256::digest(all).iter().take(6).fold(String::new(), |text, byte| text + &format!("{byte:02x}"))
}

/// A number with all its digits; a dash where there is none.
fn number(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:e}"))
}

/// The numbers of the evidence in their order, and none of its words.
fn numbers(evidence: &Evidence) -> Vec<String> {
    let of_points = |points: &[ComparedShare]| -> Vec<String> {
        let of = |p: &ComparedShare| [p.x, p.measured, p.predicted, p.sigma].map(|v| format!("{v:e}"));
        points.iter().flat_map(of).collect()
    };
    match evidence {
        Evidence::None => Vec::new(),
        Evidence::Histograms(all) => {
            all.iter().flat_map(|one| &one.counts).map(ToString::to_string).collect()
        }
        Evidence::Pairs { side, counts } => {
            [*side as u64].iter().chain(counts).map(ToString::to_string).collect()
        }
        Evidence::Shares { points, .. } | Evidence::Quantity { points, .. } => of_points(points),
        other => panic!("the digest knows nothing of {other:?}"),
    }
}

/// What an outcome comes to, by value; the digest covers what is too long to be read. Words may change, and names of fields.
fn line(outcome: &Outcome) -> String {
    let Outcome { check, subject, precision, verdict, expected, n, p, effect, detectable, rounds, .. } =
        outcome;
    let [p, effect, detectable, statistic] = [*p, *effect, *detectable, outcome.statistic].map(number);
    let values = format!(
        "{subject} {precision} {check} {verdict} {expected} {rounds} {n} {statistic} {p} {effect} {detectable} {}",
        numbers(&outcome.evidence).join(" ")
    );
    format!(
        "{subject} {precision} {check} {verdict} n={n} p={p} effect={effect} of {detectable} {}",
        digest(&values)
    )
}

/// How two subjects compare, by value.
fn compared(found: &Comparison) -> String {
    let Comparison { n, refused: [first, second], share_equal, share_within, agreement, .. } = found;
    let [largest, chi_square, ks] =
        [found.largest_difference, found.p_chi_square, found.p_kolmogorov_smirnov];
    format!(
        "{agreement}: n={n} refused={first},{second} equal={share_equal:e} within={share_within:e} largest={largest:e} \
         p={chi_square:e},{ks:e}"
    )
}

/// What a subject looks like, by value.
fn likenesses(outcomes: &[Outcome]) -> String {
    let of = |guess: diagnosis::Guess| format!("{} {:e}\n", guess.specimen.name, guess.likeness);
    diagnosis::guesses(outcomes).into_iter().map(of).collect()
}

/// Everything that is kept, by lines.
fn battery() -> String {
    let subjects = subjects();
    let outcomes = run_claims(claims::ALL, &subjects, &DRAW, || {});
    let mut text: String = outcomes.iter().map(|outcome| line(outcome) + "\n").collect();
    for claim in claims::ALL {
        let made_for = specimen::ALL.iter().find(|specimen| specimen.claim == claim.id);
        let outcomes = made_for.map(|specimen| run_claims(&[*claim], &[(specimen.subject)()], &DRAW, || {}));
        text.extend(outcomes.iter().flatten().map(|outcome| line(outcome) + "\n"));
    }
    for pair in subjects.windows(2) {
        let found = compare(&pair[0], &pair[1], &DRAW).map_or_else(|reason| reason, |found| compared(&found));
        let _ = writeln!(text, "{} and {}: {found}", pair[0].name, pair[1].name);
    }
    for specimen in specimen::ALL.iter().step_by(70) {
        let outcomes = run_claims(claims::ALL, &[(specimen.subject)()], &DRAW, || {});
        let _ = writeln!(text, "{} looks like {}", specimen.name, digest(&likenesses(&outcomes)));
    }
    for entry in coordinates::table(&DRAW) {
        let (coordinates, motion) = (entry.coordinates.name(), entry.motion.name());
        let (kept, points) = (entry.kept, entry.points);
        let _ = writeln!(text, "{coordinates}, {motion}: {kept:e} of {points}, {}", entry.is_confirmed());
    }
    text
}

#[test]
fn same_seed_same_bits() {
    let found = battery();
    if std::env::var_os("HASHED_ALPHA_BLESS").is_some() {
        std::fs::write(path(), &found).expect("the folder of the committed lines exists");
        return;
    }
    let committed = std::fs::read_to_string(path()).expect("the committed lines");
    let differ: Vec<String> = committed
        .lines()
        .zip(found.lines())
        .filter(|(committed, found)| committed != found)
        .map(|(committed, found)| format!("- {committed}\n+ {found}\n"))
        .collect();
    assert!(differ.is_empty(), "{} lines differ:\n{}", differ.len(), differ.concat());
    assert_eq!(committed.lines().count(), found.lines().count());
}
