//! The kill matrix: every specimen is rejected by the claim that it was made for, every claim rejects a specimen, and what
//! is sound passes them all.
//!
//! Every claim is the one that some specimen was made for. A run tries those entries, so that every row and every column
//! is seen to be alive, and a part of the others that leaves out no specimen and no claim; `HASHED_ALPHA_BUDGET=nightly`
//! tries all, and more of what is sound; `quick` tries only the former. `HASHED_ALPHA_BLESS=new` or `=all` writes the
//! matrix anew and tries nothing.

mod budget;

use budget::budget;
use hashed_alpha::check::Claim;
use hashed_alpha::check::diagnosis::guesses;
use hashed_alpha::check::specimen::computed::{self, computed, rejects};
use hashed_alpha::check::specimen::matrix::KillMatrix;
use hashed_alpha::check::specimen::{self, Specimen, ideal};
use hashed_alpha::check::subject::Precision;
use hashed_alpha::check::{Draw, Standing, Subject, claims, run_claims};
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::two_scale::Variant;
use libtest_mimic::{Arguments, Failed, Trial};
use rayon::prelude::*;
use std::num::NonZeroU32;
use std::path::Path;

const HOW_TO_BLESS: &str = "HASHED_ALPHA_BLESS=all cargo test --test specimens";

fn ensure(holds: bool, message: impl FnOnce() -> String) -> Result<(), Failed> {
    if holds { Ok(()) } else { Err(message().into()) }
}

/// Writes the committed matrix anew.
fn bless(which: &str) -> std::io::Result<()> {
    let known = if which == "new" { KillMatrix::committed() } else { KillMatrix::default() };
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/check/specimen/matrix.txt");
    std::fs::write(path, computed(&known).to_string())
}

/// Tries the claim that a specimen was made for, and of the others one in `stride`.
fn row(index: usize, specimen: &Specimen, stride: Option<usize>) -> Result<(), Failed> {
    let committed = KillMatrix::committed();
    let Some(row) = committed.row(specimen.name) else {
        return Err(format!("the matrix has no such row; {HOW_TO_BLESS}").into());
    };
    let is_named = |claim: &Claim| claim.id == specimen.claim;
    let is_tried = |place: usize| stride.is_some_and(|stride| (index + place).is_multiple_of(stride));
    for (place, claim) in claims::ALL.iter().enumerate() {
        if is_named(claim) || is_tried(place) {
            let rejected = rejects(claim, specimen);
            ensure(rejected || !is_named(claim), || format!("{} does not reject it", claim.id))?;
            let answer = if rejected { "rejects" } else { "does not reject" };
            ensure(rejected == row.claims.contains(&claim.id), || {
                format!("{} {answer} it, and the committed matrix says otherwise; {HOW_TO_BLESS}", claim.id)
            })?;
        }
    }
    Ok(())
}

fn passes(subject: Subject<'static>) -> Trial {
    let name = format!("{} in {} passes every claim", subject.name, subject.precision);
    Trial::test(name, move || {
        let failed: Vec<String> = run_claims(claims::ALL, &[subject], &computed::DRAW, || {})
            .iter()
            .filter(|outcome| !matches!(outcome.standing(), Standing::AsExpected | Standing::NotApplicable))
            .map(ToString::to_string)
            .collect();
        ensure(failed.is_empty(), || failed.join("\n"))
    })
}

/// What is sound: the robust threshold with every join, static and over frames, and the ideal source in all that it can
/// be. `tests/calibration.rs` tries the latter too, again and again.
fn sound() -> Vec<Subject<'static>> {
    let mut subjects = Vec::new();
    for variant in [Variant::Isotropic, Variant::Anisotropic] {
        for join in Join::ALL {
            // One weight for three scales jumps at every octave: a specimen of its own.
            if (variant, join) != (Variant::Anisotropic, Join::Interpolate) {
                let robust = Robust { join, ..Robust::new(variant) };
                let robust =
                    |precision| Subject::robust(format!("robust:{variant}:{join}"), precision, robust);
                subjects.extend(Precision::ALL.map(|precision| ideal(1, variant, precision, join)));
                subjects.push(robust(Precision::F32).stratified(NonZeroU32::new(7).expect("not zero")));
                subjects.extend(Precision::ALL.map(robust));
            }
        }
    }
    subjects
}

fn no_row_or_column_is_empty() -> Result<(), Failed> {
    let committed = KillMatrix::committed();
    let names: Vec<&str> = committed.rows.iter().map(|row| row.specimen).collect();
    let expected: Vec<&str> = specimen::ALL.iter().map(|specimen| specimen.name).collect();
    ensure(names == expected, || format!("the specimens are others; {HOW_TO_BLESS}"))?;
    for claim in claims::ALL {
        let is_its = |specimen: &Specimen| specimen.claim == claim.id;
        ensure(specimen::ALL.iter().any(is_its), || format!("no specimen is made for {}", claim.id))?;
    }
    let empty = committed.rows.iter().find(|row| row.claims.is_empty());
    ensure(empty.is_none(), || format!("nothing rejects {empty:?}"))
}

/// Two specimens of one row were made for one claim, which tells them apart by what it has seen: a distance, a bit, an octave.
fn rows_are_alike_for_one_claim_only() -> Result<(), Failed> {
    let mut rows = KillMatrix::committed().rows;
    rows.sort_by(|a, b| a.claims.cmp(&b.claims));
    let made_for =
        |name: &str| specimen::ALL.iter().find(|known| known.name == name).map(|known| known.claim);
    let alike = rows.windows(2).find(|rows| {
        rows[0].claims == rows[1].claims && made_for(rows[0].specimen) != made_for(rows[1].specimen)
    });
    ensure(alike.is_none(), || format!("{alike:?}"))
}

/// With other inputs than those of the matrix, specimens are recognised as themselves.
fn specimens_are_recognised(stride: usize) -> Result<(), Failed> {
    let tried: Vec<&Specimen> = specimen::ALL.iter().step_by(stride).collect();
    let draw = Draw { seed: 1, ..computed::DRAW };
    let is_recognised = |specimen: &&&Specimen| {
        let found = guesses(&run_claims(claims::ALL, &[(specimen.subject)()], &draw, || {}));
        let best = found.first().map_or(0.0, |guess| guess.likeness);
        found.iter().any(|guess| guess.specimen.name == specimen.name && guess.likeness >= best)
    };
    let strange: Vec<&str> = tried
        .par_iter()
        .with_max_len(1)
        .filter(|specimen| !is_recognised(specimen))
        .map(|specimen| specimen.name)
        .collect();
    ensure(5 * strange.len() <= tried.len(), || {
        format!("{} of {} are not recognised: {}", strange.len(), tried.len(), strange.join(", "))
    })
}

/// Leaving out axes without a derivative gives a number everywhere, but where the rasteriser is off by one unit the
/// cell is as small as that unit: the claim sees the share that is redrawn.
fn zero_derivatives_skipped_is_rejected_for_its_flicker() -> Result<(), Failed> {
    let skipped = specimen::ALL.iter().find(|specimen| specimen.name == "zero-derivatives-skipped");
    let subject = skipped.map(|specimen| (specimen.subject)()).ok_or("there is no such specimen")?;
    let outcomes = run_claims(&[claims::planes::AXIS_ALIGNED], &[subject], &computed::DRAW, || {});
    ensure(outcomes[0].p == Some(0.0), || outcomes[0].to_string())
}

fn main() -> std::io::Result<()> {
    if let Ok(which) = std::env::var("HASHED_ALPHA_BLESS") {
        return bless(&which);
    }
    let stride = budget().pick(None, Some(59), Some(1));
    let recognised = budget().pick(32, 32, 1);
    let mut trials: Vec<Trial> = specimen::ALL
        .iter()
        .enumerate()
        .map(|(index, specimen)| {
            let name = format!("{} is rejected by {}", specimen.name, specimen.claim);
            Trial::test(name, move || row(index, specimen, stride))
        })
        .collect();
    trials.extend(sound().into_iter().step_by(budget().pick(14, 14, 1)).map(passes));
    trials.extend([
        Trial::test("no_row_or_column_is_empty", no_row_or_column_is_empty),
        Trial::test("rows_are_alike_for_one_claim_only", rows_are_alike_for_one_claim_only),
        Trial::test("specimens_are_recognised", move || specimens_are_recognised(recognised)),
        Trial::test(
            "zero_derivatives_skipped_is_rejected_for_its_flicker",
            zero_derivatives_skipped_is_rejected_for_its_flicker,
        ),
    ]);
    libtest_mimic::run(&Arguments::from_args(), trials).exit()
}
