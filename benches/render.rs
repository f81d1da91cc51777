//! What a frame of 1920 x 1080 pixels costs under one effect each, on a fence that fills a third of it.
//!
//! `plain` has no table at all: what the others take beyond it is the price of their table.

use criterion::{Criterion, criterion_group, criterion_main};
use hashed_alpha::render::adjust::textures;
use hashed_alpha::render::effects::Effects;
use hashed_alpha::render::file::{self, SceneFile};
use hashed_alpha::render::gallery;
use hashed_alpha::render::plan::plan;
use hashed_alpha::render::prepare::prepare;
use hashed_alpha::render::run::frame;
use hashed_alpha::render::study::shots;
use std::hint::black_box;
use std::path::Path;

const TAKES: [(&str, &str); 7] = [
    ("plain", ""),
    ("finest_level", "finest_level = {}"),
    ("stochastic", "stochastic = {}"),
    ("listing_1", "hashed = {}"),
    ("robust", "robust = {}"),
    ("robust_anisotropic", "robust = { variant = 'anisotropic' }"),
    ("robust_to_coverage", "robust = {}\nalpha_to_coverage = { samples = 8, pattern = 'decorrelated' }"),
];

fn frames(criterion: &mut Criterion) {
    let entry = gallery::find("grazing-fence").expect("a scene of the gallery");
    let scene = file::read(entry.text, entry.name).expect("a sound scene");
    let scene =
        prepare(SceneFile { resolution: [1920, 1080], ..scene }, Path::new("")).expect("built-in textures");
    let shot = shots(&scene)[0];
    let mut group = criterion.benchmark_group("frame_1080p");
    group.sample_size(10);
    for (name, tables) in TAKES {
        let effects: Effects = toml::from_str(tables).expect("known effects");
        let plan = plan(&effects);
        let textures = textures(&scene, plan.textures);
        group.bench_function(name, |bencher| {
            bencher.iter(|| black_box(frame(&scene, &textures, &plan, &shot, 0)));
        });
    }
    group.finish();
}

criterion_group!(benches, frames);
criterion_main!(benches);
