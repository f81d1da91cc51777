//! `docs/scenes.md` has every key of a scene file, every effect with its keys, every number and every scene of the gallery.

use hashed_alpha::render::effect::{ALL, Effects};
use hashed_alpha::render::gallery::GALLERY;
use hashed_alpha::render::measure::study::study;
use hashed_alpha::render::scene_file::load::prepare;
use hashed_alpha::render::scene_file::read;
use hashed_alpha::render::scene_file::schema::SceneFile;
use std::collections::BTreeSet;
use std::path::Path;

const PAGE: &str = include_str!("../docs/scenes.md");

/// The names in the first column of the tables below a heading.
fn rows(page: &str, heading: &str) -> BTreeSet<String> {
    let part = page.split("\n## ").find(|part| part.starts_with(heading)).expect("a part of that heading");
    let name = |line: &str| Some(line.strip_prefix("| `")?.split('`').next()?.to_owned());
    part.lines().filter_map(name).collect()
}

/// What a page lacks, and what it has too much, as lines.
fn differences(found: &BTreeSet<String>, wanted: &BTreeSet<String>) -> Vec<String> {
    let lacking = wanted.difference(found).map(|name| format!("lacks {name}"));
    lacking
        .chain(found.difference(wanted).map(|name| format!("has {name}, which nothing reads or gives")))
        .collect()
}

/// The keys of a table, as the refusal of one that does not exist lists them.
fn keys(refusal: &str) -> Vec<String> {
    assert!(refusal.contains("unknown field `nonesuch`"), "{refusal}");
    let known = refusal.split("expected").nth(1).unwrap_or_default();
    let known = known.lines().next().unwrap_or_default();
    known.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

fn refused<T: serde::de::DeserializeOwned>(text: &str) -> String {
    toml::from_str::<T>(text).err().map(|error| error.message().to_owned()).expect("`nonesuch` is no key")
}

/// The keys of the tables of a scene file: `before` opens a table, and its keys are called by `path`.
fn keys_of_scenes() -> BTreeSet<String> {
    const TABLES: [(&str, &str); 29] = [
        ("", ""),
        ("[camera]", "camera."),
        ("[camera.motion]", "camera.motion."),
        ("[[texture]]", "texture."),
        ("[[texture]]\n[texture.leaves]", "texture.leaves."),
        ("[[texture]]\n[texture.wire]", "texture.wire."),
        ("[[texture]]\n[texture.hair]", "texture.hair."),
        ("[[texture]]\n[texture.checkerboard]", "texture.checkerboard."),
        ("[[texture]]\n[texture.constant]", "texture.constant."),
        ("[[texture]]\n[texture.ramp]", "texture.ramp."),
        ("[[texture]]\n[texture.image]", "texture.image."),
        ("[[surface]]", "surface."),
        ("[[surface]]\n[surface.card]", "surface.card."),
        ("[[surface]]\n[surface.plane]", "surface.plane."),
        ("[[surface]]\n[surface.fence]", "surface.fence."),
        ("[[surface]]\n[surface.foliage]", "surface.foliage."),
        ("[[surface]]\n[surface.instances]", "surface.instances."),
        ("[[surface]]\n[surface.hair]", "surface.hair."),
        ("[[surface]]\n[surface.stack]", "surface.stack."),
        ("[[surface]]\n[surface.checkerboard]", "surface.checkerboard."),
        ("[[surface]]\n[surface.mesh]", "surface.mesh."),
        ("[target]", "target."),
        ("[truth]", "truth."),
        ("[distance]", "distance."),
        ("[layers]", "layers."),
        ("[depth]", "depth."),
        ("[[region]]", "region."),
        ("[inset]", "inset."),
        ("[[expect]]", "expect."),
    ];
    let mut all = BTreeSet::new();
    for (before, path) in TABLES {
        let refusal = refused::<SceneFile>(&format!("{before}\nnonesuch = 1"));
        all.extend(keys(&refusal).into_iter().map(|key| format!("{path}{key}")));
    }
    all
}

#[test]
fn the_page_has_every_key_of_a_scene_file() {
    let wanted = keys_of_scenes();
    assert!(wanted.len() > 90 && wanted.contains("surface.hair.radius"), "{wanted:?}");
    let found = rows(PAGE, "The keys of a scene file");
    assert_eq!(differences(&found, &wanted), Vec::<String>::new());
    // A page without one of its rows is refused.
    let broken = PAGE.replace("| `camera.up` |", "| camera.up |");
    assert_eq!(differences(&rows(&broken, "The keys of a scene file"), &wanted), ["lacks camera.up"]);
}

#[test]
fn the_page_has_every_effect_and_its_keys() {
    let mut wanted = BTreeSet::new();
    for known in ALL {
        wanted.insert(known.name.to_owned());
        let refusal = refused::<Effects>(&format!("[{}]\nnonesuch = 1", known.name));
        wanted.extend(keys(&refusal).into_iter().map(|key| format!("{}.{key}", known.name)));
        let row = PAGE.lines().find(|line| line.starts_with(&format!("| `{}` |", known.name)));
        assert!(row.is_some_and(|row| row.contains(known.about.citation)), "{}: {row:?}", known.name);
    }
    let found = rows(PAGE, "The effects of a take");
    assert_eq!(differences(&found, &wanted), Vec::<String>::new());
    let broken = PAGE.replace("| `hashed.form` |", "| `hashed.from` |");
    assert_eq!(differences(&rows(&broken, "The effects of a take"), &wanted).len(), 2);
}

#[test]
fn the_page_has_every_number_of_the_gallery() {
    let mut wanted = BTreeSet::new();
    for entry in GALLERY {
        let file = read::read(entry.text, entry.name).expect("a sound scene");
        let regions: Vec<String> = file.region.iter().map(|region| region.name.clone()).collect();
        // The names do not depend on the size of the picture, nor on how many frames there are beyond two.
        let resolution = file.resolution.map(|side| side / 4);
        let frames = file.frames.min(2.try_into().expect("not zero"));
        let scene =
            prepare(SceneFile { resolution, frames, ..file }, Path::new("")).expect("built-in textures");
        for name in study(&scene, &mut |_, _| {}).takes.iter().flat_map(|take| take.metrics.keys()) {
            let plain = name.split('@').next().unwrap_or_default();
            wanted.extend((plain != name).then(|| "NAME@F".to_owned()));
            let of_region =
                plain.split_once('.').filter(|(_, last)| regions.iter().any(|region| region == last));
            wanted.insert(of_region.map_or_else(|| plain.to_owned(), |(first, _)| format!("{first}.NAME")));
        }
    }
    assert_eq!(differences(&rows(PAGE, "The numbers"), &wanted), Vec::<String>::new());
    let broken = PAGE.replace("| `swing` |", "| swing |");
    assert_eq!(differences(&rows(&broken, "The numbers"), &wanted), ["lacks swing"]);
}

#[test]
fn the_page_names_the_figure_of_every_scene() {
    for entry in GALLERY {
        let figure = read::read(entry.text, entry.name).expect("a sound scene").figure;
        let row = format!(
            "| [`{0}`](../src/render/gallery/{0}.toml) | {1} |",
            entry.name,
            figure.as_deref().unwrap_or("none of the sources")
        );
        assert!(PAGE.lines().any(|line| line == row), "docs/scenes.md lacks\n{row}");
    }
}
