//! A new hash is at most three files by hand: its own, its chunk of WGSL, and one line of the list.

use hashed_alpha::threshold::hash::HashKind;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Hashes that parts of the crate use for their own ends: those have more files. The paper's own two, the one that devices
/// are compared with, and the one that makes the words of a fragment.
const USED_ELSEWHERE: [HashKind; 4] = [HashKind::Sine, HashKind::SineChi2, HashKind::Mm4, HashKind::Pcg4d];

/// Files that may name another hash, each with the reason.
const MORE: [(HashKind, &str, &str); 4] = [
    (HashKind::LowbiasLinear, "threshold/robust/mod.rs", "it is the default"),
    (HashKind::Pcg3d, "cost/stages.rs", "the price of one cell after the other, for a hash of three words"),
    (
        HashKind::PcgNested,
        "threshold/stage/coverage.rs",
        "its step, the one-dimensional PCG, shuffles samples",
    ),
    (
        HashKind::PcgNested,
        "shader/gpu/program.rs",
        "its step, the one-dimensional PCG, draws the inputs of a device",
    ),
];

type Sources = BTreeMap<String, String>;

fn read(folder: &Path, root: &Path, sources: &mut Sources) {
    for entry in fs::read_dir(folder).expect("the folder exists") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            read(&path, root, sources);
        } else if let Ok(text) = fs::read_to_string(&path) {
            sources.insert(path.strip_prefix(root).expect("below it").display().to_string(), text);
        }
    }
}

/// The files that name a hash, by its kind, its file or its name for users; unit tests and comments are left out.
fn files_of<'a>(sources: &'a Sources, kind: &str, name: &str) -> Vec<&'a str> {
    let words = [kind.to_owned(), name.replace('-', "_")];
    let names_it = |text: &str| {
        let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
        let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
        lines
            .flat_map(|line| line.split(|c: char| !(c.is_alphanumeric() || c == '_')))
            .any(|word| words.iter().any(|known| known == word))
    };
    let is_own = |file: &str| words.iter().any(|word| file.ends_with(&format!("hash_cell/{word}.wgsl")));
    let named = sources.iter().filter(|(file, text)| is_own(file) || names_it(text));
    named.map(|(file, _)| file.as_str()).collect()
}

#[test]
fn a_hash_is_three_files() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut sources = Sources::new();
    read(&root, &root, &mut sources);
    let others = HashKind::ALL.into_iter().filter(|kind| !USED_ELSEWHERE.contains(kind));
    for hash in others {
        let (kind, name) = (format!("{hash:?}"), hash.name());
        let may =
            |file: &str| MORE.iter().any(|(of, at, reason)| *of == hash && *at == file && !reason.is_empty());
        let (more, own): (Vec<_>, Vec<_>) =
            files_of(&sources, &kind, name).into_iter().partition(|file| may(file));
        assert_eq!(own.len(), 3, "{name}: {own:?}");
        assert_eq!(more.len(), MORE.iter().filter(|(of, ..)| *of == hash).count(), "{name}: {more:?}");
    }
    // A match on the hashes in a fourth file is seen.
    sources
        .insert("cost/nosy.rs".to_owned(), "match hash { HashKind::Xxhash32 => 1, other => 2 }".to_owned());
    assert_eq!(files_of(&sources, "Xxhash32", "xxhash32").len(), 4);
}
