//! An effect is one file: besides it, its line in the list and, for the few that the planner or the price list choose by name, one
//! file more know of it. Scenes are counted in another test: every technique has one.

use hashed_alpha::render::effect::ALL;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Source text by its path below `src`.
type Sources = BTreeMap<String, String>;

fn read(folder: &Path, below: &str, sources: &mut Sources) {
    for entry in fs::read_dir(folder).expect("the folder exists") {
        let path = entry.expect("an entry").path();
        let name = format!("{below}{}", path.file_name().and_then(|name| name.to_str()).expect("UTF-8"));
        if path.is_dir() {
            read(&path, &format!("{name}/"), sources);
        } else if name.ends_with(".rs") {
            let text = fs::read_to_string(&path).expect("a source file");
            let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
            let is_code = |line: &&str| !line.trim_start().starts_with("//");
            sources.insert(name, code.lines().filter(is_code).collect::<Vec<_>>().join("\n"));
        }
    }
}

fn sources() -> Sources {
    let mut sources = Sources::new();
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), "", &mut sources);
    sources
}

/// The files that name the table of an effect: its module, its field in a set, or its key in a string of a scene.
fn files<'a>(sources: &'a Sources, effect: &str) -> Vec<&'a str> {
    let words = [
        format!("effect::{effect}::"),
        format!("effects.{effect}"),
        format!("set.{effect}"),
        format!("rest.{effect}"),
        format!("`{effect}`"),
        format!("`{effect}."),
        format!("\"{effect} ="),
        format!("\"{effect}\""),
    ];
    let names = |path: &str, text: &str| match path {
        "render/effect/mod.rs" => text.contains(&format!("    {effect}: ")),
        _ => words.iter().any(|word| text.contains(word)),
    };
    let own = format!("render/effect/{effect}.rs");
    let is_one = |(path, text): &(&'a String, &String)| **path == own || names(path, text);
    sources.iter().filter(is_one).map(|(path, _)| path.as_str()).collect()
}

/// Its own, its line in the list, and one that chooses effects by name. The scene that shows it makes the third of an effect
/// that nothing chooses.
const MOST: usize = 3;

/// Files of other rooms in which a word in quotes is not the table of a scene.
fn is_of_effects(path: &str) -> bool {
    path.starts_with("render/") || path.starts_with("cost/techniques") || path == "report/study.rs"
}

fn scattered(sources: &Sources) -> Vec<(&'static str, Vec<&str>)> {
    let found = ALL.iter().map(|known| (known.name, files(sources, known.name)));
    let of_effects =
        found.map(|(name, files)| (name, files.into_iter().filter(|path| is_of_effects(path)).collect()));
    of_effects.filter(|(_, files): &(_, Vec<&str>)| files.len() > MOST).collect()
}

#[test]
fn an_effect_is_one_file_and_a_line_in_the_list() {
    let sources = sources();
    for known in ALL {
        let files = files(&sources, known.name);
        let own = format!("render/effect/{}.rs", known.name);
        assert!(files.contains(&own.as_str()) && files.contains(&"render/effect/mod.rs"), "{files:?}");
    }
    assert_eq!(scattered(&sources), []);
}

/// Two more files that know of an effect are found, whichever way they name it.
#[test]
fn an_effect_that_is_scattered_is_found() {
    for text in [
        "use crate::render::effect::stipple::Stipple;",
        "fn check(effects: &Effects) -> bool { effects.stipple.is_some() }",
        "const MESSAGE: &str = \"take `stipple` out\";",
        "fn is_free(stage: &str) -> bool { stage == \"stipple\" }",
    ] {
        let mut sources = sources();
        for file in ["render/draw/free.rs", "render/measure/free.rs"] {
            sources.insert(file.to_owned(), text.to_owned());
        }
        let found = scattered(&sources);
        assert_eq!(found.iter().map(|(name, _)| *name).collect::<Vec<_>>(), ["stipple"], "{text}");
    }
}
