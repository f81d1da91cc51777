//! Every WGSL function, in a file or in a string of an effect, has a twin in Rust that is found by its name.

use proc_macro2::{TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Functions without a namesake, and why.
const EXCEPTIONS: [(&str, &str); 7] = [
    ("drawn_pcg", "`pcg` under a name that the text in front of it has not"),
    ("hash_cell", "the hash that was chosen; in Rust the method `hash` of each"),
    ("mirrored", "`u32::reverse_bits` of the standard library; not every language has it"),
    ("murmur_words", "`murmur3`: names in shader text end in no digit"),
    ("permutation", "`Permutation::drawn`"),
    ("rotated_left", "`u32::rotate_left` of the standard library"),
    ("saturated", "`Real::to_i32`: names in shader text end in no digit"),
];

fn files(folder: &Path, ending: &str, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the folder exists") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files(&path, ending, found);
        } else if path.extension().is_some_and(|extension| extension == ending) {
            found.push(path);
        }
    }
}

/// The names after `fn` in the code of files below some folders of `src`.
fn functions(folders: &[&str], ending: &str) -> BTreeSet<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut paths = Vec::new();
    folders.iter().for_each(|folder| files(&root.join(folder), ending, &mut paths));
    paths.iter().flat_map(|path| declared(&fs::read_to_string(path).expect("a source file"))).collect()
}

fn declared(text: &str) -> Vec<String> {
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    let after_fn = code.flat_map(|line| line.split("fn ").skip(1).map(str::to_owned).collect::<Vec<_>>());
    after_fn
        .map(|rest| rest.split(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or("").to_owned())
        .filter(|name| !name.is_empty())
        .collect()
}

/// The WGSL functions in string literals of Rust code.
fn in_strings(tokens: TokenStream) -> Vec<String> {
    let of_token = |token| match token {
        TokenTree::Group(group) => in_strings(group.stream()),
        TokenTree::Literal(literal) => declared(&literal.to_string()),
        TokenTree::Ident(_) | TokenTree::Punct(_) => Vec::new(),
    };
    tokens.into_iter().flat_map(of_token).collect()
}

/// The WGSL functions that effects bring with them.
fn of_effects() -> BTreeSet<String> {
    let mut paths = Vec::new();
    files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src/render/effect"), "rs", &mut paths);
    let parsed = |path: &PathBuf| fs::read_to_string(path).expect("a source file").parse().expect("Rust");
    paths.iter().flat_map(|path| in_strings(parsed(path))).collect()
}

/// The WGSL functions that have no twin.
fn without_namesake(wgsl: &BTreeSet<String>) -> Vec<String> {
    let rust = functions(&["threshold", "technique", "render/effect", "cost", "shader/gpu"], "rs");
    wgsl.iter().filter(|name| !rust.contains(*name)).cloned().collect()
}

#[test]
fn every_wgsl_function_has_a_namesake_in_rust() {
    let mut wgsl = functions(&[""], "wgsl");
    assert!(wgsl.len() > 60, "{wgsl:?}");
    let of_effects = of_effects();
    assert!(of_effects.contains("sharpened"), "{of_effects:?}");
    wgsl.extend(of_effects);
    let reasons: BTreeMap<_, _> = EXCEPTIONS.into_iter().collect();
    assert!(reasons.len() <= 8);
    let excepted: Vec<_> = reasons.keys().map(|name| (*name).to_owned()).collect();
    assert_eq!(without_namesake(&wgsl), excepted);
    // One that nobody wrote in Rust is seen.
    wgsl.insert("unheard_of".to_owned());
    assert!(without_namesake(&wgsl).contains(&"unheard_of".to_owned()));
}

#[test]
fn declarations_are_found_and_calls_are_not() {
    let text = "// fn commented() \npub fn one<R>() {}\n    const fn two(x: u32) {} fn three() { four(); }\n";
    assert_eq!(declared(text), ["one", "two", "three"]);
    let code = "const TEXT: &str = \"\nfn five(x: f32) -> f32 { return x; }\n\"; fn six() {}";
    assert_eq!(in_strings(code.parse().expect("Rust")), ["five"]);
}
