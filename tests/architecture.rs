//! The wings of the crate import each other in one direction only, and some things stand in one place only.

use std::fs;
use std::path::{Path, PathBuf};

/// Each wing and the wings that it may import.
const MAY_IMPORT: [(&str, &[&str]); 10] = [
    ("threshold", &[]),
    ("stats", &[]),
    ("scene", &["threshold"]),
    ("technique", &["threshold", "scene"]),
    ("shader", &["threshold", "scene", "technique"]),
    ("render", &["threshold", "scene", "stats", "shader", "technique"]),
    ("check", &["threshold", "scene", "stats", "shader"]),
    ("cost", &["threshold", "scene", "stats", "shader", "technique", "render"]),
    ("report", &["threshold", "scene", "stats", "shader", "technique", "render", "check", "cost"]),
    ("cli", &["threshold", "scene", "stats", "shader", "technique", "render", "check", "cost", "report"]),
];

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("the folder exists") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(rust_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The lines of a file that are code of the crate itself: no comments, nothing from the unit tests on.
fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).expect("a source file");
    let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    code.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n")
}

fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

#[test]
fn wings_import_in_one_direction() {
    for (wing, allowed) in MAY_IMPORT {
        for path in rust_files(&source().join(wing)) {
            let code = code(&path);
            for (other, _) in
                MAY_IMPORT.iter().filter(|(other, _)| *other != wing && !allowed.contains(other))
            {
                for import in [format!("crate::{other}"), format!("hashed_alpha::{other}")] {
                    assert!(!code.contains(&import), "{} imports {other}", path.display());
                }
            }
        }
    }
}

#[test]
fn every_folder_is_a_wing() {
    let mut wings: Vec<_> = fs::read_dir(source())
        .expect("src exists")
        .filter_map(|entry| entry.ok().filter(|entry| entry.path().is_dir()))
        .map(|entry| entry.file_name().into_string().expect("UTF-8"))
        .collect();
    wings.sort();
    let mut known: Vec<_> = MAY_IMPORT.iter().map(|(wing, _)| (*wing).to_owned()).collect();
    known.sort();
    assert_eq!(wings, known);
}

#[test]
fn the_threshold_takes_its_transcendentals_from_one_place() {
    for path in rust_files(&source().join("threshold")) {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        if ["real.rs", "normal.rs", "emulated.rs"].contains(&name) {
            continue;
        }
        let code = code(&path);
        // Powers of two of whole numbers are exact and may be written anywhere.
        for call in ["libm::sin", "libm::cos", "libm::log", "libm::exp(", "libm::pow", "libm::erf"] {
            assert!(!code.contains(call), "{} calls {call}", path.display());
        }
    }
}

#[test]
fn only_the_command_line_prints() {
    for wing in ["threshold", "stats", "scene", "shader", "technique", "render", "check", "cost", "report"] {
        for path in rust_files(&source().join(wing)) {
            for word in ["println!", "eprintln!", "stdout()", "stderr()"] {
                assert!(!code(&path).contains(word), "{} has {word}", path.display());
            }
        }
    }
}
