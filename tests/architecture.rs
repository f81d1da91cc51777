//! The wings of the crate import each other in one direction only, no files import each other, and some things stand in
//! one place only.

mod imports;

use imports::{Imports, Sources, circles, imports};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

/// Each wing and the wings that it imports.
const MAY_IMPORT: [(&str, &[&str]); 10] = [
    ("threshold", &[]),
    ("stats", &[]),
    ("scene", &["threshold"]),
    ("technique", &["threshold", "scene"]),
    ("shader", &["threshold", "scene"]),
    ("render", &["threshold", "scene", "shader", "technique"]),
    ("check", &["threshold", "scene", "stats", "shader"]),
    ("cost", &["threshold", "scene", "stats", "shader", "technique", "render"]),
    ("report", &["threshold", "render", "check", "cost"]),
    ("cli", &["threshold", "scene", "shader", "render", "check", "cost", "report"]),
];

/// The text of every source file.
pub fn sources() -> Sources {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut folders = vec![root.clone()];
    let mut sources = Sources::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("the folder exists") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let name =
                    path.strip_prefix(&root).expect("below the root").to_string_lossy().replace('\\', "/");
                sources.insert(name, fs::read_to_string(&path).expect("a source file"));
            }
        }
    }
    sources
}

/// What the source files import.
static IMPORTS: LazyLock<Imports> = LazyLock::new(|| imports(&sources()));

/// The same with a few files more, which know each other only.
fn with(files: &[(&str, &str)]) -> Imports {
    let more = imports(&files.iter().map(|(file, text)| ((*file).to_owned(), (*text).to_owned())).collect());
    let taken: Vec<_> = more.keys().filter(|file| IMPORTS.contains_key(*file)).collect();
    assert!(taken.is_empty(), "{taken:?}");
    IMPORTS.clone().into_iter().chain(more).collect()
}

/// The lines of a file that are code of the crate itself: no comments, nothing from the unit tests on.
pub fn code(text: &str) -> String {
    let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    code.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n")
}

fn wing(file: &str) -> Option<&str> {
    file.split_once('/').map(|(wing, _)| wing)
}

/// Each pair of a wing and another that it imports, with a file that does.
fn arrows(imports: &Imports) -> BTreeSet<(&str, &str)> {
    let pairs = imports.iter().flat_map(|(file, used)| used.iter().map(move |used| (wing(file), wing(used))));
    pairs.filter_map(|(from, to)| Some((from?, to?))).filter(|(from, to)| from != to).collect()
}

fn permitted() -> BTreeSet<(&'static str, &'static str)> {
    MAY_IMPORT.iter().flat_map(|(wing, others)| others.iter().map(move |other| (*wing, *other))).collect()
}

fn forbidden(imports: &Imports) -> Vec<(&str, &str)> {
    arrows(imports).difference(&permitted()).copied().collect()
}

fn unused(imports: &Imports) -> Vec<(&'static str, &'static str)> {
    let arrows = arrows(imports);
    permitted().into_iter().filter(|arrow| !arrows.contains(arrow)).collect()
}

/// Imports of one claim's file by another's.
fn sideways(imports: &Imports) -> Vec<(&str, &str)> {
    let is_claim = |file: &str| file.starts_with("check/claims/") && !file.ends_with("/mod.rs");
    let claims = imports.iter().filter(|(file, _)| is_claim(file));
    claims
        .flat_map(|(file, used)| used.iter().map(move |used| (file.as_str(), used.as_str())))
        .filter(|(_, used)| is_claim(used))
        .collect()
}

#[test]
fn wings_import_in_one_direction() {
    assert_eq!(forbidden(&IMPORTS), []);
    let nosy = "fn f(x: &crate::threshold::new::New) {}";
    let more = with(&[("threshold/new.rs", "pub struct New;"), ("stats/nosy.rs", nosy)]);
    assert_eq!(forbidden(&more), [("stats", "threshold")]);
}

#[test]
fn every_permission_is_used() {
    assert_eq!(unused(&IMPORTS), []);
    let without_cost = IMPORTS.iter().filter(|(file, _)| wing(file) != Some("cost"));
    let fewer = without_cost.map(|(file, used)| (file.clone(), used.clone())).collect();
    assert!(unused(&fewer).contains(&("cost", "render")));
}

#[test]
fn no_files_import_each_other() {
    assert_eq!(circles(&IMPORTS), [[""; 0]; 0]);
    let more = with(&[
        ("stats/a.rs", "use super::b::B; pub struct A;"),
        ("stats/b.rs", "pub struct B; fn f() -> crate::stats::a::A { todo!() }"),
        // A file and the module that it lies in are a circle like any other.
        ("stats/c/mod.rs", "mod d; use d::D; pub struct C;"),
        ("stats/c/d.rs", "pub struct D(super::C);"),
    ]);
    assert_eq!(circles(&more), [["stats/a.rs", "stats/b.rs"], ["stats/c/d.rs", "stats/c/mod.rs"]]);
}

#[test]
fn no_claim_imports_another() {
    assert_eq!(sideways(&IMPORTS), []);
    let more =
        with(&[("check/claims/a.rs", "pub fn f() {}"), ("check/claims/b.rs", "fn g() { super::a::f() }")]);
    assert_eq!(sideways(&more), [("check/claims/b.rs", "check/claims/a.rs")]);
}

#[test]
fn every_folder_is_a_wing() {
    let sources = sources();
    let wings: BTreeSet<&str> = sources.keys().filter_map(|file| wing(file)).collect();
    assert_eq!(wings, MAY_IMPORT.iter().map(|(wing, _)| *wing).collect());
}

#[test]
fn the_threshold_takes_its_transcendentals_from_one_place() {
    for (file, text) in sources().iter().filter(|(file, _)| wing(file) == Some("threshold")) {
        if ["real.rs", "normal.rs", "emulated.rs"].iter().any(|name| file.ends_with(name)) {
            continue;
        }
        // Powers of two of whole numbers are exact and may be written anywhere.
        for call in ["libm::sin", "libm::cos", "libm::log", "libm::exp(", "libm::pow", "libm::erf"] {
            assert!(!code(text).contains(call), "{file} calls {call}");
        }
    }
}

#[test]
fn only_the_command_line_prints() {
    for (file, text) in sources().iter().filter(|(file, _)| wing(file).is_some_and(|wing| wing != "cli")) {
        for word in ["println!", "eprintln!", "stdout()", "stderr()"] {
            assert!(!code(text).contains(word), "{file} has {word}");
        }
    }
}

/// Links of a page to files that do not exist, and names of files that no file has.
fn dead_ends(page: &str, folder: &Path, files: &BTreeSet<String>) -> Vec<String> {
    let links = page.split("](").skip(1).filter_map(|rest| Some(rest.split_once(')')?.0));
    let links = links
        .filter(|link| !link.starts_with("http") && !link.starts_with('#') && !folder.join(link).exists());
    let is_name =
        |word: &&str| word.ends_with(".rs") && !word.contains(|c: char| c.is_ascii_uppercase() || c == ' ');
    let is_known = |word: &str| files.iter().any(|file| file.ends_with(&format!("/{word}")));
    // Every second piece between marks of code is code.
    let names = page.split('`').skip(1).step_by(2).filter(is_name).filter(|word| !is_known(word));
    links.chain(names).map(str::to_owned).collect()
}

#[test]
fn pages_name_files_that_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = BTreeSet::new();
    let mut folders =
        ["src", "tests", "benches", "examples", "plots"].map(|folder| root.join(folder)).to_vec();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("the folder exists") {
            let path = entry.expect("an entry").path();
            files.insert(path.to_string_lossy().replace('\\', "/"));
            if path.is_dir() {
                folders.push(path);
            }
        }
    }
    let docs =
        fs::read_dir(root.join("docs")).expect("docs exists").map(|entry| entry.expect("an entry").path());
    let pages = docs.filter(|path| path.extension().is_some_and(|extension| extension == "md"));
    for page in ["README.md", "ARCHITECTURE.md"].map(|page| root.join(page)).into_iter().chain(pages) {
        let text = fs::read_to_string(&page).expect("a page");
        let dead = dead_ends(&text, page.parent().expect("a folder"), &files);
        assert!(dead.is_empty(), "{}: {dead:?}", page.display());
    }
    let wrong = "[a](src/lib.rs) [b](src/no.rs) `threshold/cdf.rs` `threshold/no.rs`";
    assert_eq!(dead_ends(wrong, root, &files), ["src/no.rs", "threshold/no.rs"]);
}
