//! `docs/findings.md` has a command in every row, and what the command names is there.

use crate::architecture::sources;
use hashed_alpha::check::claims;
use hashed_alpha::render::gallery;
use std::path::Path;

fn text(name: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(name))
        .unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The command of a row, and whether it has a number.
fn rows() -> Vec<(String, String)> {
    let page = text("docs/findings.md");
    let rows = page.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| finding |"));
    rows.map(|line| {
        let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(str::trim).collect();
        let [_, number, command] = cells[..] else { panic!("three cells: {line}") };
        (number.to_owned(), command.trim_matches('`').to_owned())
    })
    .collect()
}

#[test]
fn every_row_has_a_number_and_a_command_that_names_what_there_is() {
    let rows = rows();
    assert!(rows.len() >= 40, "{}", rows.len());
    let sentences = text("docs/sentences.md");
    for (number, command) in rows {
        assert!(number.chars().any(|c| c.is_ascii_digit()), "{number}: {command}");
        let words: Vec<&str> = command.split_whitespace().collect();
        match words[..] {
            ["cargo", "test", "--test", "sentences", "--", name] => {
                assert!(sentences.contains(&format!("`{name}`")), "{command}");
            }
            ["cargo", "test", "--test", "main", name] => {
                let (file, test) = name.split_once("::").expect("a file and a test of it");
                assert!(text(&format!("tests/{file}.rs")).contains(test), "{command}");
            }
            ["cargo", "test", "--lib", name] => {
                assert!(sources().values().any(|text| text.contains(name)), "{command}");
            }
            ["hashed-alpha", "render", scene] => assert!(gallery::find(scene).is_some(), "{command}"),
            ["hashed-alpha", "check" | "grain" | "cost", ..] => {
                for pair in words.windows(2).filter(|pair| pair[0] == "--only") {
                    let is_of = |id: &str| id == pair[1] || id.starts_with(&format!("{}.", pair[1]));
                    assert!(claims::ALL.iter().any(|claim| is_of(claim.id)), "{command}");
                }
            }
            _ => panic!("a command of another kind: {command}"),
        }
    }
}
