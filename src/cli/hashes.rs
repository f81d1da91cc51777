//! `hashes`: the hashes of the list, and what is measured of each.

use super::args::HashesArgs;
use super::failure::Failure;
use super::{Ending, output};
use hashed_alpha::check::claims;
use hashed_alpha::cost::Effort;
use hashed_alpha::cost::hashes::{self as clock, HashTime};
use hashed_alpha::report::directory::write_atomically;
use hashed_alpha::report::hashes::{Entry, Measured, figure, json_lines, list, table};
use hashed_alpha::threshold::hash::HashKind;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::Write;
use std::path::Path;

/// Prints the list, or measures.
pub fn run(args: &HashesArgs) -> Result<Ending, Failure> {
    let text = if args.measure {
        let found = measured(args)?;
        if args.json { lines(&found)? } else { table(&found).aligned() }
    } else {
        let kinds = if args.hashes.is_empty() { &HashKind::ALL[..] } else { &args.hashes };
        list(kinds).aligned()
    };
    let mut results = output::results();
    results.write_all(text.as_bytes()).and_then(|()| results.flush()).map_err(Failure::Output)?;
    Ok(Ending::Consistent)
}

/// Measures hashes; each is written as soon as it is known.
fn measured(args: &HashesArgs) -> Result<Vec<Entry>, Failure> {
    if let Some(page) = &args.page {
        // Before minutes are spent.
        super::cost::with_table(page, MARK, "")?;
    }
    std::fs::create_dir_all(&args.out).map_err(|source| Failure::File {
        action: "create",
        place: args.out.display().to_string(),
        source,
    })?;
    let file = args.out.join("hashes.jsonl");
    if cfg!(debug_assertions) {
        output::remark(
            "note",
            "times are of a build that checks for overflow; `cargo run --release` does not",
        );
    }
    // Times mean something beside each other only: all hashes take turns, whichever are asked for.
    let effort = if args.quick { Effort::Quick } else { Effort::Full };
    let times = super::cost::measured(clock::steps(effort), |done| clock::times(effort, done));
    let wanted: Vec<(HashKind, HashTime)> = HashKind::ALL
        .into_iter()
        .zip(times)
        .filter(|(kind, _)| args.hashes.is_empty() || args.hashes.contains(kind))
        .collect();
    let bar = ProgressBar::new(wanted.len() as u64);
    if let Ok(style) = ProgressStyle::with_template("{bar:20} {pos} of {len} hashes, {eta} left  {msg}") {
        bar.set_style(style);
    }
    let mut known = Vec::new();
    for (kind, time) in wanted {
        bar.set_message(kind.name());
        if bar.is_hidden() {
            output::remark("note", format_args!("measures {kind}"));
        }
        let measured = Measured::new(kind, claims::ALL, args.doublings)
            .map_err(|reason| Failure::Usage(format!("{kind}: {reason}")))?;
        known.push(Entry { measured, nanoseconds: time.into() });
        write_atomically(&file, lines(&known)?.as_bytes())?;
        bar.inc(1);
    }
    bar.finish_and_clear();
    write_atomically(&args.out.join("hashes.svg"), figure(&known).as_bytes())?;
    output::remark(
        "note",
        format_args!("numbers and figure are {} and hashes.svg beside it", file.display()),
    );
    if let Some(path) = &args.page {
        page_and_files(path, &known)?;
    }
    Ok(known)
}

/// The table of the page.
const MARK: &str = "hashes";

/// Writes the table into a page, and figure and numbers beside it.
fn page_and_files(path: &Path, known: &[Entry]) -> Result<(), Failure> {
    super::cost::into_page(path, MARK, &table(known).markdown())?;
    let folder = path.parent().unwrap_or_else(|| Path::new(""));
    write_atomically(&folder.join("hashes.svg"), figure(known).as_bytes())?;
    Ok(write_atomically(&folder.join("hashes.jsonl"), lines(known)?.as_bytes())?)
}

fn lines(known: &[Entry]) -> Result<String, Failure> {
    json_lines(known).map_err(|error| Failure::Output(error.into()))
}
