//! `docs/hashes.md` is what `hashes --measure` wrote, and what can be had again in a few seconds is had again.
//!
//! `cargo run --release -- hashes --measure --page docs/hashes.md` writes page, figure and numbers anew; `HASHED_ALPHA_BLESS=all cargo test
//! --test main hashes::` page and figure from the numbers.

use hashed_alpha::check::catalogue::{quality, range_in_half, range_in_single};
use hashed_alpha::check::claims;
use hashed_alpha::cost::hashes::operations;
use hashed_alpha::report::cost::page::replaced;
use hashed_alpha::report::hashes::{Entry, entries, figure, table};
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::robust::Robust;
use std::path::{Path, PathBuf};

fn docs(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(name)
}

fn committed(name: &str) -> String {
    std::fs::read_to_string(docs(name)).expect("a file of docs")
}

fn catalogue() -> Vec<Entry> {
    entries(&committed("hashes.jsonl")).expect("entries")
}

#[test]
fn the_page_and_the_figure_show_the_numbers() {
    let (page, all) = (committed("hashes.md"), catalogue());
    let names: Vec<&str> = all.iter().map(|entry| entry.measured.hash.as_str()).collect();
    assert_eq!(names, HashKind::ALL.map(HashKind::name), "every hash, in the order of the list");
    let written = replaced(&page, "hashes", &table(&all).markdown()).expect("the marks of the table");
    if std::env::var_os("HASHED_ALPHA_BLESS").is_some() {
        std::fs::write(docs("hashes.md"), &written).expect("the page can be written");
        std::fs::write(docs("hashes.svg"), figure(&all)).expect("the figure can be written");
        return;
    }
    assert!(written == page, "HASHED_ALPHA_BLESS=all cargo test --test main hashes::");
    assert!(
        committed("hashes.svg") == figure(&all),
        "HASHED_ALPHA_BLESS=all cargo test --test main hashes::"
    );
}

/// The default is the fastest that no claim rejects.
#[test]
fn the_default_is_the_first_of_the_table() {
    assert_eq!(table(&catalogue()).rows[0][0], Robust::HASH.name());
}

/// What claims reject at the first number of samples, how far indices may grow, and what a shader has to do.
#[test]
fn what_is_said_of_each_hash_is_found_again() {
    for (kind, entry) in HashKind::ALL.into_iter().zip(catalogue()) {
        let said = &entry.measured;
        let found = quality(kind, claims::ALL, 0);
        assert_eq!(found.claims, said.claims, "{kind}");
        let found: Vec<_> = found.rejections.iter().map(|found| found.claim).collect();
        let at_once: Vec<_> =
            said.rejected_by.iter().filter(|by| by.doublings == 0).map(|by| by.claim.as_str()).collect();
        assert_eq!(found, at_once, "{kind}");
        assert_eq!([range_in_single(kind), range_in_half(kind)], [said.range, said.range_in_half], "{kind}");
        assert_eq!(operations(kind).ok(), Some(said.operations), "{kind}");
    }
}
