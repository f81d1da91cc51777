//! Every technique that the sources name is shown by a take of the gallery, tested, and priced.

use hashed_alpha::cost::Effort;
use hashed_alpha::cost::techniques::{take, techniques, without};
use hashed_alpha::render::draw::adjust::textures;
use hashed_alpha::render::draw::plan::plan;
use hashed_alpha::render::effect;
use hashed_alpha::render::effect::Effects;
use hashed_alpha::render::measure::study::study;
use hashed_alpha::render::scene_file::load::prepare;
use hashed_alpha::render::scene_file::schema::{SceneFile, Takes};
use hashed_alpha::technique::{ALL, TRUTH, Technique};
use std::collections::HashSet;
use std::fs;
use std::path::Path;

/// The names of all test functions and of the rows of the page of claims.
fn tests() -> HashSet<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders = vec![root.join("src"), root.join("tests")];
    let mut names = HashSet::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).expect("a source file");
                let functions = text.split("#[test]\n").skip(1).filter_map(|after| {
                    let (name, _) = after.trim_start().strip_prefix("fn ")?.split_once('(')?;
                    Some(name.to_owned())
                });
                let rows = text.split("id: \"").skip(1).filter_map(|after| after.split('"').next());
                names.extend(functions.chain(rows.map(str::to_owned)));
            }
        }
    }
    names
}

/// What an entry lacks, if anything.
fn missing(technique: &Technique, tests: &HashSet<String>) -> Option<String> {
    let Some((file, set)) = take(technique.scene, technique.take) else {
        return Some(format!("no take `{}` in the scene `{}`", technique.take, technique.scene));
    };
    let module = Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(technique.module.replace("::", "/"));
    if !module.with_extension("rs").is_file() && !module.join("mod.rs").is_file() {
        return Some(format!("no module `{}`", technique.module));
    }
    if !tests.contains(technique.test) {
        return Some(format!("no test `{}`", technique.test));
    }
    let priced = match technique.price {
        TRUTH => file.truth.is_some(),
        table => effect::ALL.iter().any(|known| known.name == table && (known.is_in)(&set)),
    };
    (!priced).then(|| format!("no table `{}` in its take", technique.price))
}

#[test]
fn every_technique_has_a_scene_a_test_and_a_price() {
    let tests = tests();
    let lacking: Vec<(&str, String)> =
        ALL.iter().filter_map(|technique| Some((technique.name, missing(technique, &tests)?))).collect();
    assert!(lacking.is_empty(), "{lacking:#?}");
}

#[test]
fn an_entry_that_names_what_does_not_exist_is_found() {
    let tests = tests();
    let sound = *ALL.iter().find(|technique| technique.name == "fade-in").expect("in the list");
    assert_eq!(missing(&sound, &tests), None);
    for broken in [
        Technique { scene: "fade-out", ..sound },
        Technique { take: "faded", ..sound },
        Technique { module: "threshold::fade_out", ..sound },
        Technique { test: "it_works", ..sound },
        Technique { price: "jitter", ..sound },
        Technique { price: TRUTH, scene: "octaves", take: "linear", ..sound },
    ] {
        assert!(missing(&broken, &tests).is_some(), "{broken:?}");
    }
}

#[test]
fn every_technique_is_on_the_price_list() {
    let prices = techniques(Effort::Quick, &|| ());
    let names: Vec<&str> = prices.iter().map(|price| price.technique.name).collect();
    assert_eq!(names.len(), ALL.len(), "{names:?}");
    for price in prices {
        assert!(price.with > 0.0 && price.without > 0.0, "{price:?}");
    }
    // What something else needs is not taken away alone.
    let (_, set) = take("temporal-orders", "ascending, 8").expect("in the gallery");
    assert_eq!(without(&set, "robust"), Effects::default());
    assert!(without(&set, "temporal").robust.is_some());
}

/// Hashed thresholds with alpha-to-coverage and temporal antialiasing, and those that fade in, anisotropic, with temporal
/// antialiasing: what Figs. 11 and 12 combine.
#[test]
fn combinations_cost_what_they_predict() {
    for (name, tables) in [
        ("to coverage, averaged", &["robust", "alpha_to_coverage", "temporal", "average"][..]),
        ("faded in, anisotropic, averaged", &["robust", "fade_in", "temporal", "average"]),
    ] {
        let (file, set) = take("hair", name).expect("in the gallery");
        for table in tables {
            let known = effect::ALL.iter().find(|known| known.name == *table).expect("an effect");
            assert!((known.is_in)(&set), "{name}: {table}");
        }
        let frames = 3.try_into().expect("not zero");
        let sets = Takes::Sets(vec![set.clone()]);
        let file = SceneFile { frames, effects: sets, truth: None, expect: Vec::new(), ..file };
        let scene = prepare(file, Path::new("")).expect("built-in textures");
        let plan = plan(&set);
        let predicted = plan.predict(&scene, &textures(&scene, plan.textures), &mut || ());
        let counted = study(&scene, &mut |_, _| ()).takes[0].cost;
        assert_eq!(counted, predicted, "{name}");
        let (fragments, pixels) = (counted.fragments, 3 * 96 * 96);
        let samples = if set.alpha_to_coverage.is_some() { 8 } else { 1 };
        assert_eq!((counted.tests, counted.blends), (samples * fragments, pixels), "{name}");
        // Eq. 9 takes one hash more; the copula of the anisotropic threshold takes eight.
        assert_eq!(counted.hashes, if samples == 8 { 3 } else { 8 } * fragments, "{name}");
    }
}
