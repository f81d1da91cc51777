//! What a new effect costs: its own file, its line in the list, and the scene that shows it; no other file under `src` knows of
//! it by hand. The few that something chooses by name are listed, each with the reason. The page of scenes is counted apart.

use crate::architecture::{code, sources};
use hashed_alpha::render::effect::{ALL, GALLERY, techniques};
use std::collections::BTreeMap;

/// Source text by its path below `src`.
type Sources = BTreeMap<String, String>;

/// Files that may name effects beside their own and the list, each with the effects and the reason.
const MORE: [(&str, &[&str], &str); 2] = [
    (
        "render/measure/auto.rs",
        &["alpha_to_coverage", "average", "fade_in", "fixed", "premultiplied", "robust", "temporal"],
        "`effects = \"auto\"` chooses among these",
    ),
    ("cost/techniques.rs", &["hashed", "stochastic"], "whole frames are those of Table 1"),
];

/// Whether a file could know of the tables of scenes: elsewhere the same word is a threshold, an effect size or a unit.
fn may_know(path: &str) -> bool {
    let rooms = ["render/", "cost/techniques", "report/study.rs", "report/figure/distance.rs"];
    rooms.iter().any(|room| path.starts_with(room))
        || ["scene", "explain", "render"].iter().any(|word| path.starts_with(&format!("cli/{word}")))
}

/// The files that name the table of an effect: its module, its field in a set, or its key in a string.
fn files<'a>(sources: &'a Sources, effect: &str) -> Vec<&'a str> {
    let ends = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
    let paths = ["effect::", "effects.", "set.", "rest."].map(|before| format!("{before}{effect}"));
    let quoted = ["`E`", "`E.", "\"E\"", "\"E ="].map(|key| key.replace('E', effect));
    let has = |text: &str| {
        let code = code(text);
        let is_path =
            |word: &String| code.match_indices(word.as_str()).any(|(at, _)| ends(&code[at + word.len()..]));
        paths.iter().any(is_path) || quoted.iter().any(|key| code.contains(key))
    };
    let [own, list] = [format!("render/effect/{effect}.rs"), "render/effect/mod.rs".to_owned()];
    let names = |path: &str, text: &str| {
        *path == own
            || (path == list && text.contains(&format!("    {effect}: ")))
            || (path != list && has(text))
    };
    let known = sources.iter().filter(|(path, text)| may_know(path) && names(path, text));
    known.map(|(path, _)| path.as_str()).collect()
}

/// Effects with the files that know of them without a reason.
fn scattered(sources: &Sources) -> Vec<(&'static str, Vec<&str>)> {
    let of = |effect: &'static str| {
        let own = format!("render/effect/{effect}.rs");
        let has_reason = |path: &str| {
            path == own
                || path == "render/effect/mod.rs"
                || MORE.iter().any(|(at, effects, _)| *at == path && effects.contains(&effect))
        };
        (effect, files(sources, effect).into_iter().filter(|path| !has_reason(path)).collect())
    };
    ALL.iter().map(|known| of(known.name)).filter(|(_, files): &(_, Vec<&str>)| !files.is_empty()).collect()
}

#[test]
fn an_effect_is_its_file_a_line_in_the_list_and_a_scene() {
    let sources = sources();
    assert_eq!(scattered(&sources), []);
    for (file, effects, _) in MORE {
        for effect in effects {
            assert!(files(&sources, effect).contains(&file), "{file} does not need {effect}");
        }
    }
    // What shows an effect is a scene of the list.
    for (known, technique) in techniques() {
        let is_shown = |text: &str| text.contains(known.name);
        let scene = GALLERY.iter().find(|scene| scene.name == technique.shown[0]);
        assert!(scene.is_some_and(|scene| is_shown(scene.text) || known.name == "fixed"), "{technique:?}");
    }
}

/// One file more that knows of an effect is found.
#[test]
fn an_effect_that_is_scattered_is_found() {
    for text in [
        "use crate::render::effect::stipple::Stipple;",
        "fn check(effects: &Effects) -> bool { effects.stipple.is_some() }",
        "const MESSAGE: &str = \"take `stipple` out\";",
        "fn is_free(stage: &str) -> bool { stage == \"stipple\" }",
    ] {
        for file in ["render/draw/free.rs", "render/measure/auto.rs", "cli/explain.rs"] {
            let mut sources = sources();
            sources.entry(file.to_owned()).or_default().insert_str(0, &format!("{text}\n"));
            assert_eq!(scattered(&sources), [("stipple", vec![file])], "{text}");
        }
    }
    let prefix = "fn check(effects: &Effects) -> bool { effects.fixed_x.is_some() }";
    assert_eq!(scattered(&Sources::from([("render/draw/free.rs".to_owned(), prefix.to_owned())])), []);
}
