//! Every level, budget and constant of the verdict has its reason beside it; `docs/constants.md` lists them.
//!
//! `HASHED_ALPHA_BLESS=all cargo test --test main constants::` writes the page anew.

use crate::architecture::sources;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

/// A constant of the verdict.
struct Constant {
    file: String,
    name: String,
    value: String,
    /// The comment above it.
    reason: String,
}

/// The numbers, arrays of numbers and ranges that stand as constants at the top level of the files of `check`; not those of
/// the specimens, which are part of their defects.
fn constants(sources: &BTreeMap<String, String>) -> Vec<Constant> {
    let mut found = Vec::new();
    for (file, text) in
        sources.iter().filter(|(file, _)| file.starts_with("check/") && !file.starts_with("check/specimen/"))
    {
        let own = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
        let lines: Vec<&str> = own.lines().collect();
        for (at, line) in lines.iter().enumerate() {
            let bare = line.trim_start_matches("pub ").trim_start_matches("pub(crate) ");
            let Some((name, rest)) = bare.strip_prefix("const ").and_then(|rest| rest.split_once(": "))
            else {
                continue;
            };
            let kind = rest.trim_start_matches("core::ops::").trim_start_matches("RangeInclusive<");
            let kind = kind.trim_start_matches("Range<").trim_start_matches('[');
            if !["u8", "u32", "u64", "usize", "i32", "i64", "f32", "f64"]
                .iter()
                .any(|of| kind.starts_with(of))
            {
                continue;
            }
            let above = lines[..at].iter().rev().take_while(|line| line.starts_with("///"));
            let words: Vec<&str> = above.map(|line| line.trim_start_matches("///").trim()).collect();
            let value = lines[at..].join("\n");
            let value =
                value.split_once("= ").and_then(|(_, value)| value.split_once(";\n")).map_or("", |v| v.0);
            found.push(Constant {
                file: file.trim_start_matches("check/").to_owned(),
                name: name.to_owned(),
                value: value
                    .lines()
                    .map(|line| line.split("//").next().unwrap_or_default().trim())
                    .filter(|line| !line.is_empty())
                    .collect::<Vec<_>>()
                    .join(" "),
                reason: words.into_iter().rev().collect::<Vec<_>>().join(" "),
            });
        }
    }
    found
}

fn without_reason(constants: &[Constant]) -> Vec<&str> {
    constants.iter().filter(|of| of.reason.split(' ').count() < 3).map(|of| of.name.as_str()).collect()
}

fn page(constants: &[Constant]) -> String {
    let mut text = "# Constants of the verdict\n\nEvery level, budget and bound under `src/check`, with its reason. What several \
                    parts share stands in\n`tolerance.rs`, the rest at the top of the file that uses it. Sizes of samples are those of \
                    budget `ci`. This page is\ngenerated from the source by `tests/constants.rs`.\n"
        .to_owned();
    let mut file = "";
    for of in constants {
        if of.file != file {
            file = &of.file;
            let _ = write!(text, "\n## `{file}`\n\n| constant | value | reason |\n|---|---|---|\n");
        }
        let _ = writeln!(
            text,
            "| `{}` | `{}` | {} |",
            of.name,
            of.value,
            of.reason.replace('|', "\\|").replace("[`", "`").replace("`]", "`")
        );
    }
    text
}

#[test]
fn every_constant_has_its_reason_and_is_listed() {
    let mut sources = sources();
    let found = constants(&sources);
    assert!(found.len() > 100, "{}", found.len());
    assert!(without_reason(&found).is_empty(), "{:?}", without_reason(&found));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/constants.md");
    let page = page(&found);
    if std::env::var_os("HASHED_ALPHA_BLESS").is_some() {
        std::fs::write(&path, &page).expect("the folder of the page exists");
    }
    assert!(std::fs::read_to_string(&path).expect("the page") == page, "docs/constants.md is out of date");

    sources.insert("check/claims/new.rs".into(), "const LEVEL: f64 = 0.05;\n".into());
    assert_eq!(without_reason(&constants(&sources)), ["LEVEL"]);
}
