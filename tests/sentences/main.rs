//! The sentences of the five sources, each measured: `docs/sentences.md` is written by this test and checked by it.
//!
//! One trial a row: it measures again and compares with the committed line. `HASHED_ALPHA_BLESS=1 cargo test --test sentences`
//! writes the page anew and tries nothing.

mod beyond;
mod conference;
mod coverage;
mod fade;
mod hashing;
mod maps;
mod mask;
mod measure;
mod others;
mod problem;
mod row;
mod slides;
mod temporal;
mod unchecked;

use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::sine::hash_3d;
use hashed_alpha::threshold::two_scale::Variant;
use libtest_mimic::{Arguments, Failed, Trial};
use measure::{Plane, flicker, independent, listing, run_lengths};
use rayon::prelude::*;
use row::{Row, Source, Verdict, line};
use std::collections::HashSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

const HOW_TO_BLESS: &str = "HASHED_ALPHA_BLESS=1 cargo test --test sentences";

/// The sources in the order of the page.
fn sources() -> Vec<Source> {
    let source =
        |title, parts: &[&'static [Row]]| Source { title, rows: parts.iter().copied().flatten().collect() };
    vec![
        source(
            "Wyman & McGuire, *Improved Alpha Testing Using Hashed Sampling*, TVCG 2017",
            &[problem::ROWS, hashing::ROWS, fade::ROWS, temporal::ROWS, coverage::ROWS, beyond::ROWS],
        ),
        source("Wyman, *Hashed Alpha Testing*, slides, GDC 2017", &[slides::ROWS]),
        source(
            "Wyman & McGuire, *Hashed Alpha Testing*, I3D 2017, where it says more or other",
            &[conference::ROWS],
        ),
        source("Humus, *Custom alpha to coverage*, 2009", &[others::HUMUS]),
        source("Ols, *Stippled Alpha*, 2009", &[others::OLS]),
    ]
}

fn page() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/sentences.md")
}

/// Measures every row.
fn measured() -> Vec<String> {
    let rows: Vec<&Row> = sources().into_iter().flat_map(|source| source.rows).collect();
    rows.par_iter().with_max_len(1).map(|row| line(row, &(row.measure)())).collect()
}

/// The page that has these lines, in the order of the rows.
fn page_of(lines: &[String]) -> String {
    let count = |verdict: Verdict| lines.iter().filter(|line| line.ends_with(&verdict.at_end())).count();
    let [confirmed, refined, refuted] = Verdict::ALL.map(count);
    let mut page = String::new();
    let _ = write!(
        page,
        "# The sentences of the sources, measured\n\nEach checkable sentence, in our words, with what we measure and on how \
         many samples. *Confirmed*: it holds as it\nstands. *Refined*: it holds under a condition that it does not state, or \
         for another reason; the figures say which.\n*Refuted*: it does not hold. Of {} sentences {confirmed} are confirmed, \
         {refined} refined, {refuted} refuted.\n\n`cargo test --test sentences -- NAME` measures the row of that name again; \
         `{HOW_TO_BLESS}` writes\nthis page. Seeds are fixed, so the figures are the same on every machine; no time is measured \
         for them.\n",
        lines.len(),
    );
    let mut lines = lines.iter();
    for source in sources() {
        let _ = write!(
            page,
            "\n## {}\n\n| name | place | sentence | measured | n | verdict |\n|---|---|---|---|---|---|\n",
            source.title
        );
        for line in lines.by_ref().take(source.rows.len()) {
            page.push_str(line);
            page.push('\n');
        }
    }
    page.push_str(&unchecked());
    page
}

/// The last part of the page.
fn unchecked() -> String {
    let mut part =
        "\n## Not checkable here\n\n| place | sentence | what it would take |\n|---|---|---|\n".to_owned();
    for (place, sentence, missing) in unchecked::SENTENCES {
        let _ = writeln!(part, "| {place} | {sentence} | {missing} |");
    }
    part
}

fn committed() -> Result<String, Failed> {
    std::fs::read_to_string(page())
        .map_err(|error| format!("docs/sentences.md: {error}; {HOW_TO_BLESS}").into())
}

/// Measures one row again.
fn is_as_committed(row: &Row) -> Result<(), Failed> {
    let measured = line(row, &(row.measure)());
    if committed()?.lines().any(|line| line == measured) {
        Ok(())
    } else {
        Err(format!("docs/sentences.md does not have the line\n{measured}\n{HOW_TO_BLESS}").into())
    }
}

/// The page has the rows of the sources in their order and no others, and around them what their verdicts make of it.
fn rows_are_those_of_the_page() -> Result<(), Failed> {
    let sources = sources();
    let names: Vec<&str> = sources.iter().flat_map(|source| &source.rows).map(|row| row.id).collect();
    let page = committed()?;
    let lines: Vec<String> = page.lines().filter(|line| line.starts_with("| `")).map(str::to_owned).collect();
    let on_page: Vec<&str> = lines.iter().filter_map(|line| line[3..].split('`').next()).collect();
    let different: HashSet<&str> = names.iter().copied().collect();
    if names != on_page || different.len() != names.len() || names.len() < 60 {
        return Err(format!("rows and page differ, or a name is used twice; {HOW_TO_BLESS}").into());
    }
    // All but the lines, which have trials of their own: counts, titles, what is not checkable.
    if page == page_of(&lines) {
        Ok(())
    } else {
        Err(format!("what stands around the lines is out of date; {HOW_TO_BLESS}").into())
    }
}

/// What the rows measure with tells a broken threshold from a sound one.
fn tools_tell_broken_thresholds() -> Result<(), Failed> {
    let plane = Plane::tilted(20.0, 0.012, 0.0);
    let run = |threshold: &dyn Fn(&Footprint<f64>) -> f64| run_lengths(&plane.image(96, threshold), 96)[0];
    let sound = run(&listing(Variant::Isotropic, 4.0));
    // Positions that are hashed as they are, and one threshold for all.
    let unfloored = run(&|at| hash_3d::<f64>(at.position));
    let constant = run(&|_| 0.5);
    let (still, cycle) = (flicker(0.4, |chi, _| chi), flicker(0.4, independent));
    if unfloored < 1.01 && sound > 1.5 && constant.is_infinite() && still == 0.0 && cycle > 0.05 {
        Ok(())
    } else {
        Err(format!("runs {unfloored}, {sound}, {constant}; flicker {still}, {cycle}").into())
    }
}

fn main() -> std::io::Result<()> {
    if std::env::var_os("HASHED_ALPHA_BLESS").is_some() {
        return std::fs::write(page(), page_of(&measured()));
    }
    let mut trials = vec![
        Trial::test("rows_are_those_of_the_page", rows_are_those_of_the_page),
        Trial::test("tools_tell_broken_thresholds", tools_tell_broken_thresholds),
    ];
    for row in sources().into_iter().flat_map(|source| source.rows) {
        trials.push(Trial::test(row.id, move || is_as_committed(row)));
    }
    libtest_mimic::run(&Arguments::from_args(), trials).exit()
}
