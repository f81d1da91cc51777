//! What a frame costs under one effect each, and that an effect which a scene does not have costs nothing.
//!
//! * `frame_1080p`: a fence that fills a third of 1920 x 1080 pixels. `plain` has no table at all: what the others take
//!   beyond it is the price of their table.
//! * `effects`: a frame of the take that shows each technique, with its table and without.
//! * `absent`: a frame by a plan without any table, or with `hashed` alone, beside the same frame by the few lines that know
//!   of nothing else, see [`by_hand`]. Both are drawn in turn, and the middle of the ratios is printed.

use criterion::{Criterion, criterion_group, criterion_main};
use hashed_alpha::cost::techniques::{take, without};
use hashed_alpha::render::draw::fragments::Space;
use hashed_alpha::render::draw::fragments::{Fragments, Needs};
use hashed_alpha::render::draw::frame::frame;
use hashed_alpha::render::draw::rasterise::{Screen, TILE};
use hashed_alpha::render::draw::shot::shots;
use hashed_alpha::render::draw::texture::{Access, Texture};
use hashed_alpha::render::effect::Effects;
use hashed_alpha::render::effect::plan::plan;
use hashed_alpha::render::effect::techniques;
use hashed_alpha::render::gallery;
use hashed_alpha::render::measure::picture::{LEAF, Picture, SKY};
use hashed_alpha::render::scene_file::load::{Scene, prepare};
use hashed_alpha::render::scene_file::read;
use hashed_alpha::render::scene_file::schema::{SceneFile, Takes};
use hashed_alpha::threshold::batch::Batch;
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::stage::clamp::clamp_last;
use hashed_alpha::threshold::two_scale::Variant;
use rayon::prelude::*;
use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

const TAKES: [(&str, &str); 7] = [
    ("plain", ""),
    ("finest_level", "finest_level = {}"),
    ("stochastic", "stochastic = {}"),
    ("listing_1", "hashed = {}"),
    ("robust", "robust = {}"),
    ("robust_anisotropic", "robust = { variant = 'anisotropic' }"),
    ("robust_to_coverage", "robust = {}\nalpha_to_coverage = { samples = 8, pattern = 'decorrelated' }"),
];

fn fence() -> Scene {
    let entry = gallery::find("grazing-fence").expect("a scene of the gallery");
    let scene = read::read(entry.text, entry.name).expect("a sound scene");
    prepare(SceneFile { resolution: [1920, 1080], ..scene }, Path::new("")).expect("built-in textures")
}

fn frames(criterion: &mut Criterion) {
    let scene = fence();
    let shot = shots(&scene)[0];
    let mut group = criterion.benchmark_group("frame_1080p");
    group.sample_size(10);
    for (name, tables) in TAKES {
        let effects: Effects = toml::from_str(tables).expect("known effects");
        let plan = plan(&effects);
        let textures = scene.textures(&plan.setup.textures);
        group.bench_function(name, |bencher| {
            bencher.iter(|| black_box(frame(&scene, &textures, &plan, &shot, 0)));
        });
    }
    group.finish();
}

fn effects(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("effects");
    group.sample_size(10).warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_secs(1));
    for (effect, technique) in techniques() {
        let [scene, name] = technique.shown;
        let (file, set) = take(scene, name).expect("in the gallery");
        for (name, set) in [("with", set.clone()), ("without", without(&set, effect))] {
            let file = SceneFile { effects: Takes::Sets(vec![set.clone()]), ..file.clone() };
            let scene = prepare(file, Path::new("")).expect("built-in textures");
            let plan = plan(&set);
            let textures = scene.textures(&plan.setup.textures);
            let shot = shots(&scene)[0];
            group.bench_function(format!("{}/{name}", technique.name), |bencher| {
                bencher.iter(|| black_box(frame(&scene, &textures, &plan, &shot, 0)));
            });
        }
    }
    group.finish();
}

/// Columns of a tile, kept from tile to tile.
#[derive(Default)]
struct Columns {
    fragments: Fragments,
    access: Vec<Access>,
    alpha: Vec<f32>,
    threshold: Vec<f32>,
}

/// A renderer that never had another effect: alpha test under one threshold, or under Listing 1.
fn by_hand(scene: &Scene, textures: &[Texture], hashed: Option<&HashedAlpha<HashKind>>) -> Picture {
    let camera = shots(scene)[0].camera(scene, 0, 1);
    let needs = Needs { texture_derivatives: true, footprint: hashed.is_some(), ..Needs::default() };
    let screen = Screen::new(&scene.mesh, &camera, 0.0, glam::DVec2::ZERO, Space::Object, needs);
    let texture = |triangle: u32| &textures[scene.mesh.triangles[triangle as usize].texture as usize];
    let tile = |columns: &mut Columns, tile: usize| {
        let Columns { fragments, access, alpha, threshold } = columns;
        let mut pixels = vec![(SKY, 0.0_f32); (TILE * TILE) as usize];
        screen.fragments(tile, fragments);
        access.clear();
        alpha.clear();
        threshold.clear();
        let mut texels = 0;
        for at in 0..fragments.len() {
            let texture = texture(fragments.triangle[at]);
            let place = texture.access(fragments.texcoord[at], fragments.dtdx[at], fragments.dtdy[at]);
            alpha.push(texture.alpha(&place, &mut texels));
            access.push(place);
        }
        threshold.resize(fragments.len(), 0.5);
        if let Some(hashed) = hashed {
            Batch::new(*hashed).thresholds(&fragments.footprint.columns(), threshold);
            threshold.iter_mut().for_each(|threshold| *threshold = clamp_last(*threshold));
        }
        let mut nearest = vec![u32::MAX; pixels.len()];
        for at in (0..fragments.len()).filter(|&at| alpha[at] >= threshold[at]) {
            let held = &mut nearest[usize::from(fragments.pixel[at])];
            if *held == u32::MAX || fragments.depth[at] < fragments.depth[*held as usize] {
                *held = at as u32;
            }
        }
        for (pixel, &at) in pixels.iter_mut().zip(&nearest).filter(|&(_, &at)| at != u32::MAX) {
            let triangle = fragments.triangle[at as usize];
            let colour = texture(triangle).colour(&access[at as usize]).unwrap_or(LEAF);
            *pixel = (colour.map(|c| (c * screen.shade(triangle)).min(1.0)), 1.0);
        }
        pixels
    };
    let tiles: Vec<_> = (0..screen.tiles()).into_par_iter().map_init(Columns::default, tile).collect();
    let mut picture = Picture::sky(camera.resolution);
    for (index, pixels) in tiles.iter().enumerate() {
        let ([left, top], [width, height]) = screen.tile(index);
        for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
            let to = ((top + y) * picture.size[0] + left + x) as usize;
            (picture.colour[to], picture.coverage[to]) = pixels[(y * TILE + x) as usize];
        }
    }
    picture
}

#[expect(clippy::print_stdout, reason = "criterion has no place for ratios")]
fn absent(criterion: &mut Criterion) {
    let scene = fence();
    let shot = shots(&scene)[0];
    let (variant, hash) = (Variant::Isotropic, HashKind::Sine);
    let listing = HashedAlpha { variant, hash, hash_scale: 1.0, form: CdfForm::Literal };
    let mut group = criterion.benchmark_group("absent");
    group.sample_size(10);
    for (name, tables, hashed) in [("plain", "", None), ("hashed", "hashed = {}", Some(&listing))] {
        let plan = plan(&toml::from_str(tables).expect("known effects"));
        let textures = scene.textures(&plan.setup.textures);
        let planned = || frame(&scene, &textures, &plan, &shot, 0);
        let by_hand = || by_hand(&scene, &textures, hashed);
        assert_eq!(planned().picture, by_hand(), "the two draw the same");
        let mut ratios: Vec<f64> = (0..31)
            .map(|_| {
                let begun = Instant::now();
                black_box(planned());
                let between = Instant::now();
                black_box(by_hand());
                (between - begun).as_secs_f64() / between.elapsed().as_secs_f64()
            })
            .collect();
        ratios.sort_by(f64::total_cmp);
        let [low, middle, high] = [7, 15, 23].map(|at| ratios[at]);
        println!(
            "absent/{name}: by plan over by hand {middle:.3} (half of 31 pairs from {low:.3} to {high:.3})"
        );
        group.bench_function(format!("{name}/by_plan"), |bencher| bencher.iter(|| black_box(planned())));
        group.bench_function(format!("{name}/by_hand"), |bencher| bencher.iter(|| black_box(by_hand())));
    }
    group.finish();
}

criterion_group!(benches, frames, effects, absent);
criterion_main!(benches);
