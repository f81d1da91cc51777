//! Scenes: the gallery shows what it must, plans cost what they predict, and an absent table leaves no trace.

use hashed_alpha::cost::drawing::grass;
use hashed_alpha::render::draw::cost::Census;
use hashed_alpha::render::draw::plan::Plan;
use hashed_alpha::render::effect::plan::{check, plan};
use hashed_alpha::render::effect::{ALL, Effects};
use hashed_alpha::render::gallery::GALLERY;
use hashed_alpha::render::measure::predict::predict;
use hashed_alpha::render::measure::study::{Study, study};
use hashed_alpha::render::scene_file::load::{Scene, prepare};
use hashed_alpha::render::scene_file::read;
use hashed_alpha::render::scene_file::schema::{SceneFile, Takes};
use hashed_alpha::threshold::batch::Model;
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::hash::{Cell, Hash, HashKind};
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::stage::order::Order;
use hashed_alpha::threshold::two_scale::Variant;
use proptest::prelude::*;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

fn read(name: &str) -> SceneFile {
    let entry = GALLERY.iter().find(|entry| entry.name == name).expect("a scene of the gallery");
    read::read(entry.text, name).unwrap_or_else(|error| panic!("{error}"))
}

fn ready(file: SceneFile) -> Scene {
    prepare(file, Path::new("")).expect("built-in textures")
}

fn drawn(scene: &Scene) -> Study {
    study(scene, &mut |_, _| {})
}

/// The scene of a name in a sixteenth of its pixels and two frames, without truth.
fn small(name: &str) -> SceneFile {
    let file = read(name);
    let resolution = file.resolution.map(|side| side / 4);
    SceneFile { resolution, frames: 2.try_into().expect("not zero"), expect: Vec::new(), truth: None, ..file }
}

fn with(file: &SceneFile, effects: Effects) -> Scene {
    ready(SceneFile { effects: Takes::Sets(vec![effects]), ..file.clone() })
}

/// The sets of effects of all scenes, each with its scene, and one with much at once.
fn takes() -> Vec<(SceneFile, Effects)> {
    let mut takes = Vec::new();
    for entry in GALLERY {
        let file = small(entry.name);
        if let Takes::Sets(sets) = &file.effects {
            takes.extend(sets.iter().map(|set| (file.clone(), set.clone())));
        }
    }
    let combined = r#"
        name = "combined"
        hashed = { variant = "anisotropic" }
        independent = { frames = 4 }
        coordinates = { space = "world" }
        temporal = { frames = 4, order = "phase-rotated" }
        alpha_to_coverage = { samples = 4, pattern = "decorrelated" }
        fade_in = { full_noise_lod = 3.0, anisotropy = true }
        premultiplied = {}
        limited_level = { level = 4.0 }
        level_bias = { levels = -0.7 }
        supersampling = { samples = 2 }
        jitter = { frames = 4 }
        conservative = {}
        foveated = { gaze = [20.0, 20.0], radius = 5.0, slope = 0.1 }
        occlusion = { reach = 0.5, variant = "anisotropic" }
        history = { weight = 0.2, clamp = true, reproject = true }
        average = { frames = 4 }
    "#;
    takes.push((small("vanishing-foliage"), toml::from_str(combined).expect("known effects")));
    for table in [
        "alpha_to_coverage = { samples = 8, pattern = 'hardware' }",
        "alpha_to_coverage = { samples = 5, pattern = 'pixel' }",
        "alpha_to_coverage = { samples = 6, pattern = 'random' }\nstochastic = {}",
        "screen_door = { mask = 'fixed' }",
        "screen_door = { mask = 'bayer' }",
        "screen_door = { mask = 'random' }",
        "screen_door = { mask = 'hashed' }",
        "stipple = { density = 'high' }\nfixed = { threshold = 0.3 }",
        "stipple = { density = 'low' }",
        "multisampling = { samples = 5 }\nlevel_threshold = {}",
        "multisampling = { samples = 5 }\nalpha_to_coverage = { samples = 5, pattern = 'decorrelated' }\nrobust = {}",
        "multisampling = { samples = 64 }\nsupersampling = { samples = 2 }\nstipple = { density = 'high' }",
    ] {
        let file = small("vanishing-foliage");
        let set: Effects = toml::from_str(table).expect("known effects");
        assert_eq!(check(&set), Ok(()), "{table}");
        takes.push((file, set));
    }
    takes
}

#[test]
fn every_scene_shows_what_it_must() {
    for entry in GALLERY {
        let scene = ready(read(entry.name));
        assert!(scene.file.sentence.is_some(), "{}", entry.name);
        assert!(!scene.file.expect.is_empty(), "{} expects nothing", entry.name);
        let study = drawn(&scene);
        let wrong: Vec<&str> = study
            .checked
            .iter()
            .filter(|checked| !checked.holds)
            .map(|checked| checked.text.as_str())
            .collect();
        assert!(wrong.is_empty(), "{}: {wrong:#?}", entry.name);
    }
}

/// Every surface by the name that a user types, with the wrong one told. Meshes of files: `tests/render_assets.rs`.
#[test]
fn surfaces_of_every_kind_are_seen() {
    for (texture, surface) in [
        ("texture = 'leaf'", "plane = { size = [1.0, 1.0] }"),
        ("texture = 'leaf'", "card = { size = [1.0, 1.0] }"),
        ("texture = 'leaf'", "fence = { panels = 3, size = [0.4, 0.5] }"),
        ("texture = 'leaf'", "foliage = { cards = 20, card = 0.3, radii = [0.5, 0.5, 0.5] }"),
        ("texture = 'leaf'", "instances = { count = 9, size = [0.3, 0.4], ground = [0.5, 0.5] }"),
        ("texture = 'leaf'", "hair = { strips = 9, size = [0.2, 0.7], radius = 0.4 }"),
        ("texture = 'leaf'", "stack = { cards = 2, size = [0.9, 0.9], distance = 0.1 }"),
        ("", "checkerboard = { size = [1.2, 1.2], square = 0.3 }"),
    ] {
        let text = format!(
            "name = 'surface'\nresolution = [60, 45]\n[camera]\neye = [0.3, 1.5, 3.0]\ntarget = [0.0, 0.1, 0.0]\n\
             [[texture]]\nname = 'leaf'\nconstant = {{ alpha = 1.0 }}\n[[surface]]\n{texture}\n{surface}\n"
        );
        let coverage = |text: &str| {
            let file = read::read(text, "surface.toml").unwrap_or_else(|error| panic!("{error}"));
            drawn(&ready(file)).takes[0].metrics["coverage"]
        };
        assert!((0.005..0.9).contains(&coverage(&text)), "{surface}: {}", coverage(&text));
        let kind = surface.split(' ').next().expect("a word");
        let wrong = text.replace(&format!("\n{kind} ="), &format!("\n{kind}x ="));
        let error = read::read(&wrong, "surface.toml").expect_err("no such surface").to_string();
        assert!(error.contains(&format!("`{kind}x`. Did you mean `{kind}`?")), "{error}");
    }
}

/// Half of the squares of a board, which are opaque, and nothing but them: as its texture on a plane.
#[test]
fn a_checkerboard_is_a_plane_with_squares() {
    let board = read("checkerboard");
    let mut plane = board.clone();
    let text = "name = 'plane'\n[camera]\neye = [0.0, 1.0, 0.0]\ntarget = [0.0, 0.0, 0.0]\nup = [1.0, 0.0, 0.0]\n\
        [[texture]]\nname = 'board'\nwrap = 'repeat'\nfilter = 'anisotropic'\ncheckerboard = { squares = 8 }\n\
        [[surface]]\ntexture = 'board'\nposition = [0.0, 0.013, 0.0]\nturn = [0.0, 31.0, 0.0]\n\
        plane = { size = [400.0, 400.0], repeat = [100.0, 100.0] }\n";
    let other = read::read(text, "plane.toml").expect("sound");
    (plane.texture, plane.surface) = (other.texture, other.surface);
    let small = |file: SceneFile| SceneFile { resolution: [60, 40], expect: Vec::new(), truth: None, ..file };
    let [board, plane] = [board, plane].map(|file| drawn(&ready(small(file))));
    assert!(board.sheet(None) == plane.sheet(None));
}

#[test]
fn an_expectation_that_does_not_come_out_is_told() {
    let mut file = small("noise-scales");
    file.expect = read("noise-scales").expect;
    file.expect[0].at_most = Some(0.1);
    file.expect[1].metric = "flipz".to_owned();
    let checked = drawn(&ready(file)).checked;
    assert!(!checked[0].holds && !checked[1].holds && checked[1].text.contains("was not measured"));
}

#[test]
fn plans_cost_what_they_predict() {
    for (file, effects) in takes() {
        let scene = with(&file, effects);
        let study = drawn(&scene);
        for take in &study.takes {
            let predicted =
                predict(&take.plan, &scene, &scene.textures(&take.plan.setup.textures), &mut || ());
            assert_eq!(take.cost, predicted, "{}: {}", file.name, take.plan.name);
        }
    }
    // What the planner chooses, too.
    let scene = ready(small("auto"));
    let study = drawn(&scene);
    let take = &study.takes[0];
    assert_eq!(
        take.cost,
        predict(&take.plan, &scene, &scene.textures(&take.plan.setup.textures), &mut || ())
    );
}

/// What a table leaves behind in a plan: stages by the effect that they simulate.
fn traces(plan: &Plan, effect: &str) -> usize {
    plan.told().filter(|told| told.effect == Some(effect)).count()
}

#[test]
fn an_absent_table_leaves_no_trace() {
    let mut removed = 0;
    for (file, set) in takes() {
        let whole = plan(&set);
        for known in ALL.iter().filter(|known| known.is_in(&set)) {
            let mut rest = set.clone();
            (known.remove)(&mut rest);
            if check(&rest).is_err() {
                // Something else needs it.
                continue;
            }
            removed += 1;
            let without = plan(&rest);
            assert_eq!(traces(&without, known.name), 0, "{}: {}", file.name, known.name);
            let names = |plan: &Plan| plan.setup.needs.names();
            // Who reads the finest level alone needs no derivatives to choose one.
            let spares = known.name == "finest_level";
            assert!(
                names(&without).iter().all(|need| spares || names(&whole).contains(need)),
                "{}",
                known.name
            );
            let census =
                Census { fragments: 1000, texels: 8000, pixels: 100, shown: 90, ..Census::default() };
            let costs = |plan: &Plan| plan.cost_of_frame(census).quantities();
            let cheaper = costs(&without).into_iter().zip(costs(&whole)).all(|(less, more)| less.1 <= more.1);
            // Who blends everything spares the test.
            assert!(cheaper || known.name == "naive_blend", "{}: {}", file.name, known.name);
            if let (Ok(with), Ok(without)) = (whole.shader(), without.shader()) {
                let chunks = |text: &str| text.matches("\nfn ").count();
                assert!(chunks(&without) <= chunks(&with), "{}: {}", file.name, known.name);
            }
        }
        assert_eq!(ALL.iter().map(|known| traces(&plan(&Effects::default()), known.name)).sum::<usize>(), 0);
    }
    assert!(removed > 30, "{removed}");
}

#[test]
fn an_absent_table_of_the_scene_is_not_measured() {
    let file = SceneFile {
        truth: read("vanishing-foliage").truth,
        depth: read("stipple-buffers").depth,
        region: read("layers").region,
        ..small("vanishing-foliage")
    };
    let names =
        |file: SceneFile| -> Vec<String> { drawn(&ready(file)).takes[0].metrics.keys().cloned().collect() };
    let whole = names(file.clone());
    let still = SceneFile {
        camera: hashed_alpha::render::draw::view::View { motion: None, ..file.camera.clone() },
        frames: 1.try_into().expect("not zero"),
        ..file.clone()
    };
    for (without, gone) in [
        (SceneFile { truth: None, ..file.clone() }, &["rmse", "ssim", "coverage_ratio"][..]),
        (SceneFile { distance: None, ..file.clone() }, &["@"]),
        (SceneFile { layers: None, ..file.clone() }, &["layer_correlation"]),
        (SceneFile { depth: None, ..file.clone() }, &["depth."]),
        (SceneFile { region: Vec::new(), ..file.clone() }, &[".two"]),
        (still, &["flips", "changed"]),
    ] {
        let left = names(without);
        for gone in gone {
            assert!(whole.iter().any(|name| name.contains(gone)), "{gone}");
            assert!(!left.iter().any(|name| name.contains(gone)), "{gone}: {left:?}");
        }
    }
}

#[test]
fn the_truth_moves_as_the_takes_do() {
    // A still error and a moving one: a truth that lags behind would double the second.
    let file = SceneFile { frames: 8.try_into().expect("not zero"), ..read("samples-converge") };
    let motion = read("vanishing-foliage").camera.motion;
    let Takes::Sets(sets) = &file.effects else { panic!("takes") };
    let file = SceneFile {
        truth: read("vanishing-foliage").truth,
        expect: Vec::new(),
        effects: Takes::Sets(sets[3..4].to_vec()),
        ..file
    };
    let moving = SceneFile {
        camera: hashed_alpha::render::draw::view::View { motion, ..file.camera.clone() },
        ..file.clone()
    };
    let error = |file| drawn(&ready(file)).takes[0].metrics["rmse_coverage"];
    let (still, moving) = (error(file), error(moving));
    assert!((moving / still - 1.0).abs() < 0.1, "{still} {moving}");
}

/// "Given hashed xi_1, xi_2" (§8): the order of a pixel's samples is as stable as the threshold, and changes with it.
#[test]
fn a_still_scene_keeps_its_samples_unless_its_thresholds_change() {
    let file = SceneFile { frames: 4.try_into().expect("not zero"), ..small("layers") };
    let flips = |source: &str, pattern: &str| {
        let text = format!("{source}\nalpha_to_coverage = {{ samples = 8, pattern = '{pattern}' }}");
        drawn(&with(&file, toml::from_str(&text).expect("known effects"))).takes[0].metrics["flips.pixel"]
    };
    for pattern in ["decorrelated", "random"] {
        for source in ["hashed = {}", "robust = {}", "robust = {}\njitter = { frames = 1 }"] {
            assert_eq!(flips(source, pattern), 0.0, "{source}, {pattern}");
        }
        for source in [
            "stochastic = {}",
            "robust = {}\ntemporal = { frames = 4 }",
            "robust = {}\nindependent = { frames = 4 }",
        ] {
            assert!(flips(source, pattern) > 0.01, "{source}, {pattern}");
        }
    }
}

#[test]
fn shader_text_has_the_chunks_of_its_stages_only() {
    let of = |text: &str| {
        let set: Effects = toml::from_str(text).expect("known effects");
        plan(&set).shader().expect("a shader")
    };
    for (with, chunk, without) in [
        ("hashed = {}\nfade_in = {}", "fn fade_in", "hashed = {}"),
        ("hashed = {}\ntemporal = { frames = 8 }", "fn stratified", "hashed = {}"),
        (
            "robust = {}\nalpha_to_coverage = { samples = 4, pattern = 'decorrelated' }",
            "fn fragment_pair",
            "robust = {}",
        ),
        ("robust = { variant = 'anisotropic' }", "fn robust", "fixed = {}"),
        ("hashed = {}", "fn hash", "stochastic = {}"),
        ("occlusion = { reach = 1.0 }", "fn cosine_direction", ""),
        (
            "hashed = {}\nconservative = {}",
            "fn corrected",
            "hashed = {}\nconservative = { corrected = false }",
        ),
        (
            "hashed = {}\nfoveated = { gaze = [1.0, 2.0], radius = 3.0, slope = 0.1 }",
            "fn coarser_by",
            "hashed = {}",
        ),
        (
            "hashed = {}\nalpha_to_coverage = { samples = 4, pattern = 'random' }",
            "fn shuffled",
            "hashed = {}\nalpha_to_coverage = { samples = 4, pattern = 'decorrelated' }",
        ),
        (
            "alpha_to_coverage = { samples = 4, pattern = 'pixel' }",
            "fn pixel_value",
            "screen_door = { mask = 'fixed' }",
        ),
        ("screen_door = { mask = 'hashed' }", "fn randomised", "screen_door = { mask = 'random' }"),
        (
            "alpha_to_coverage = { samples = 4, pattern = 'regular' }\nsharpened = {}",
            "fn sharpened",
            "alpha_to_coverage = { samples = 4, pattern = 'regular' }",
        ),
        ("stipple = { density = 'high' }", "fn is_apart", "fixed = {}"),
    ] {
        assert!(of(with).contains(chunk), "{with}");
        assert!(!of(without).contains(chunk), "{without}");
    }
}

/// A hash that counts how often it is asked.
struct Counting<'a>(HashKind, &'a AtomicU64);

impl Hash<f32> for Counting<'_> {
    fn hash(&self, cell: &Cell<f32>) -> f32 {
        self.1.fetch_add(1, Ordering::Relaxed);
        Hash::<f32>::hash(&self.0, cell)
    }
}

#[test]
fn a_threshold_takes_as_many_hashes_as_its_plan_says() {
    let footprint = Footprint::<f32> {
        position: glam::vec3(0.31, -1.72, 2.43),
        dpdx: glam::vec3(0.012, 0.003, -0.007),
        dpdy: glam::vec3(0.002, 0.0094, 0.0033),
    };
    for variant in Variant::ALL {
        let count = AtomicU64::new(0);
        let hash = Counting(HashKind::Mm4, &count);
        let form = CdfForm::Literal;
        let _ = HashedAlpha { variant, hash, hash_scale: 1.0, form }.threshold(&footprint);
        let model = Model::Hashed(HashedAlpha { variant, hash: HashKind::Mm4, hash_scale: 1.0, form });
        assert_eq!(count.load(Ordering::Relaxed), model.hashes(), "{variant}");
    }
    for variant in [Variant::Isotropic, Variant::Anisotropic] {
        for join in Join::ALL {
            let count = AtomicU64::new(0);
            let preset = Robust { join, ..Robust::new(variant) };
            let Robust { hash_scale, repairs, .. } = preset;
            let counting =
                Robust { variant, hash: Counting(HashKind::Mm4, &count), hash_scale, join, repairs };
            counting.threshold(&footprint).expect("a finite footprint");
            assert_eq!(count.load(Ordering::Relaxed), Model::Robust(preset).hashes(), "{variant} {join}");
        }
    }
}

/// Many triangles and rays: what is sorted and searched on several threads, and counted beforehand.
#[test]
fn a_meadow_is_drawn_alike_on_any_number_of_threads_and_costs_what_is_predicted() {
    let scene = grass(10_000, [96, 54]).expect("a sound scene");
    let drawn_by = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| drawn(&scene))
    };
    let [one, two, five] = [1, 2, 5].map(drawn_by);
    for other in [&two, &five] {
        for (one, other) in one.takes.iter().zip(&other.takes) {
            assert!(one.shown == other.shown, "{}", one.plan.name);
            assert_eq!((&one.metrics, one.cost), (&other.metrics, other.cost));
        }
    }
    for take in &one.takes {
        let textures = scene.textures(&take.plan.setup.textures);
        assert_eq!(take.cost, predict(&take.plan, &scene, &textures, &mut || ()), "{}", take.plan.name);
        assert_eq!(take.cost.rays > 1000, take.plan.setup.rays);
    }
}

#[test]
fn one_thread_or_two_draw_the_same() {
    for name in ["vanishing-foliage", "subpixel-motion", "samples-converge"] {
        let scene = ready(small(name));
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            pool.install(|| drawn(&scene))
        };
        let (one, two) = (with(1), with(2));
        for (one, two) in one.takes.iter().zip(&two.takes) {
            assert!(one.sequence == two.sequence, "{name}");
            assert_eq!((&one.metrics, one.cost), (&two.metrics, two.cost));
        }
        assert!(one.sheet(None) == two.sheet(None), "{name}");
        // Another seed draws something else.
        let other = ready(SceneFile { seed: 1, ..scene.file.clone() });
        assert!(drawn(&other).sheet(None) != one.sheet(None), "{name}");
    }
}

#[test]
fn alpha_0_never_shows_and_alpha_1_has_no_hole() {
    let file = small("noise-scales");
    for (_, set) in takes() {
        for alpha in [0.0, 1.0] {
            let mut file = file.clone();
            file.texture[0].constant.as_mut().expect("a veil").alpha = alpha;
            // The edges of the card are outside the picture.
            let study = drawn(&with(&file, set.clone()));
            let coverage = study.takes[0].metrics["coverage"];
            // A single pixel would be 3e-4; averages round.
            assert!((coverage - alpha).abs() < 1e-6, "{coverage}: {}", study.takes[0].plan.name);
        }
    }
}

/// A table of that name with parameters by `words`; the literal listings on planes where they compute a number.
fn table(name: &str, words: [u32; 3]) -> String {
    let of = |all: &[&str], word: u32| format!("'{}'", all[word as usize % all.len()]);
    let share = |word: u32| f64::from(word % 1000 + 1) / 1000.0;
    let hash = || of(&["sine", "sine-chi2", "mm4", "xxhash32", "pcg3d", "pcg4d", "pcg-nested"], words[0]);
    let scale = 0.2 + 5.0 * share(words[1]);
    // In these coordinates a card or the image follows an axis: Listing 2 divides by zero there, see below.
    let follows_an_axis = matches!(words[0] % 8, 2 | 4 | 6 | 7);
    let variant = |literal: bool| {
        of(&["isotropic", "anisotropic"], if literal && follows_an_axis { 0 } else { words[2] })
    };
    let frames = words[0] % 8 + 1;
    let orders = Order::ALL.map(Order::name);
    let spaces = ["object", "deformed", "part", "world", "texture", "eye", "screen", "device"];
    let patterns = ["regular", "jittered", "decorrelated", "independent", "hardware", "random", "pixel"];
    let inner = match name {
        "premultiplied" | "finest_level" | "level_threshold" | "stochastic" | "test_then_blend"
        | "naive_blend" => String::new(),
        "supersampling" => format!("samples = {}", words[0] % 3 + 1),
        "scaled_alpha" => format!("interpolated = {}", words[0].is_multiple_of(2)),
        "level_bias" => format!("levels = {:.1}", 4.0 * share(words[0]) - 3.0),
        "limited_level" => format!("level = {:.1}", 6.0 * share(words[0])),
        "scaled_texels" => format!("radius = {}", words[0] % 3),
        "fixed" => format!("threshold = {}", share(words[0])),
        "hashed" => format!("hash = {}, hash_scale = {scale}, variant = {}", hash(), variant(true)),
        "robust" => {
            let join = of(&["interpolate", "copula", "dithered"], words[0] / 7);
            format!("hash = {}, hash_scale = {scale}, variant = {}, join = {join}", hash(), variant(false))
        }
        "screen_door" => format!("mask = {}", of(&["fixed", "bayer", "random", "hashed"], words[0])),
        "stipple" => format!("density = {}", of(&["high", "low"], words[0])),
        "coordinates" => format!("space = {}", of(&spaces, words[0])),
        "independent" => format!("frames = {frames}, by = {}", of(&["offset", "word"], words[1])),
        "jitter" | "average" => format!("frames = {frames}"),
        "temporal" => format!("frames = {frames}, order = {}", of(&orders, words[1])),
        // The same samples for both.
        "multisampling" => format!("samples = {}", words[2] % 9 + 1),
        "alpha_to_coverage" => {
            format!("samples = {}, pattern = {}", words[2] % 9 + 1, of(&patterns, words[0]))
        }
        "fade_in" => {
            let (lod, authored) = (0.1 + 6.0 * share(words[0]), share(words[1]));
            format!(
                "full_noise_lod = {lod}, authored = {authored}, anisotropy = {}",
                words[2].is_multiple_of(2)
            )
        }
        // At its cutoff a surface is kept by half of the samples, so that a cutoff of 1 halves what is opaque.
        "sharpened" => format!("cutoff = {}", 0.999 * share(words[0])),
        "conservative" => format!("corrected = {}", words[0].is_multiple_of(2)),
        "foveated" => format!("gaze = [5.0, 9.0], radius = 3.0, slope = {}", share(words[0])),
        "occlusion" => {
            let chi = of(&["two-hashes", "offsets", "word", "seeded", "random"], words[1]);
            format!("reach = {}, chi = {chi}", share(words[0]))
        }
        "history" => {
            let [clamp, reproject] = [words[1], words[2]].map(|word| word.is_multiple_of(2));
            format!("weight = {}, clamp = {clamp}, reproject = {reproject}", share(words[0]))
        }
        _ => panic!("`{name}` needs parameters here"),
    };
    format!("{name} = {{ {inner} }}\n")
}

/// The effects that `present` chooses; of those that do not go together, the ones that `order` puts first.
fn chosen(present: u64, order: u64, words: [u32; 3]) -> Effects {
    let mut set = Effects::default();
    let start = order as usize % ALL.len();
    for (index, known) in ALL.iter().enumerate().cycle().skip(start).take(ALL.len()) {
        if present >> index & 1 == 0 {
            continue;
        }
        let text: String = ALL
            .iter()
            .filter(|other| other.name == known.name || other.is_in(&set))
            .map(|other| table(other.name, words))
            .collect();
        let more: Effects = toml::from_str(&text).expect("known effects");
        if check(&more).is_ok() {
            set = more;
        }
    }
    set
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_combination_of_effects_shows_alpha_0_or_holes_in_alpha_1(
        present in any::<u64>(), order in any::<u64>(), words in prop::array::uniform3(any::<u32>()),
    ) {
        let mut file = SceneFile { resolution: [16, 16], ..small("noise-scales") };
        let set = chosen(present, order, words);
        for alpha in [0.0, 1.0] {
            file.texture[0].constant.as_mut().expect("a veil").alpha = alpha;
            let scene = with(&file, set.clone());
            let study = drawn(&scene);
            let take = &study.takes[0];
            // A single pixel would be 4e-3; averages round.
            let coverage = take.metrics["coverage"];
            prop_assert!((coverage - alpha).abs() < 1e-5, "{coverage} for {alpha}: {}", take.plan.name);
            let predicted = predict(&take.plan, &scene, &scene.textures(&take.plan.setup.textures), &mut || ());
            prop_assert_eq!(take.cost, predicted, "{}", take.plan.name);
        }
    }
}

/// The property above reaches every effect, and pairs of them.
#[test]
fn combinations_of_effects_have_every_effect_beside_every_other_that_it_goes_with() {
    let mut rng =
        proptest::test_runner::TestRng::deterministic_rng(proptest::test_runner::RngAlgorithm::ChaCha);
    let sets: Vec<Effects> =
        (0..600).map(|_| chosen(rng.next_u64(), rng.next_u64(), [0; 3].map(|_| rng.next_u32()))).collect();
    for known in ALL {
        assert!(sets.iter().any(|set| known.is_in(set)), "{}", known.name);
    }
    let pairs = ALL.iter().flat_map(|a| ALL.iter().map(move |b| (a, b)));
    let met = pairs.filter(|(a, b)| sets.iter().any(|set| a.is_in(set) && b.is_in(set))).count();
    assert!(met > ALL.len() * ALL.len() / 2, "{met}");
}

/// The one way that the literal listings leave, and the property leaves out: where they divide by zero they compute no
/// threshold, and keep everything.
#[test]
fn a_literal_listing_shows_alpha_0_on_a_plane_that_follows_an_axis() {
    let mut file = SceneFile { resolution: [16, 16], ..small("noise-scales") };
    file.surface[0].model_turn = [0.0; 3];
    file.texture[0].constant.as_mut().expect("a veil").alpha = 0.0;
    let coverage = |text: &str| {
        let set: Effects = toml::from_str(text).expect("known effects");
        drawn(&with(&file, set)).takes[0].metrics["coverage"]
    };
    assert_eq!(coverage("hashed = { variant = 'anisotropic' }"), 1.0);
    assert_eq!(coverage("robust = { variant = 'anisotropic' }"), 0.0);
}

#[test]
fn a_scene_that_calls_for_nothing_gets_the_plain_alpha_test() {
    let near = |distance: f64| {
        let text = format!(
            "name = 'card'\neffects = 'auto'\nresolution = [120, 90]\n[camera]\neye = [0.1, 0.2, {distance}]\ntarget = [0.0, 0.0, 0.0]\n\
             [[texture]]\nname = 'leaf'\nleaves = {{}}\n[[surface]]\ntexture = 'leaf'\ncard = {{ size = [1.0, 1.0] }}\n"
        );
        drawn(&ready(read::read(&text, "card.toml").expect("sound"))).takes[0].plan.clone()
    };
    assert_eq!(near(0.5).setup, plan(&Effects::default()).setup);
    assert_eq!(traces(&near(40.0), "robust"), 1);
}

/// Frames of a still scene repeat with the strata of their thresholds, and those of fresh random numbers never do.
#[test]
fn a_cycle_of_frames_closes() {
    let file = small("hair");
    let still = |effects: &str| {
        let camera = hashed_alpha::render::draw::view::View { motion: None, ..file.camera.clone() };
        let effects: Effects = toml::from_str(effects).expect("known effects");
        with(&SceneFile { camera, ..file.clone() }, effects)
    };
    for (source, cycle) in [
        ("hashed = {}\ntemporal = { frames = 3 }", Some(3)),
        ("robust = {}\nindependent = { frames = 2 }\ntemporal = { frames = 3 }", Some(6)),
        ("hashed = {}", Some(1)),
        ("stochastic = {}\ntemporal = { frames = 3 }", None),
    ] {
        for pattern in ["decorrelated", "random"] {
            let effects = format!("{source}\nalpha_to_coverage = {{ samples = 4, pattern = '{pattern}' }}");
            let scene = still(&effects);
            let Takes::Sets(sets) = &scene.file.effects else { panic!("a set was given") };
            let plan = plan(&sets[0]);
            assert_eq!(plan.setup.pipeline.and_then(|pipeline| pipeline.cycle()), cycle, "{effects}");
            assert!(plan.setup.needs.names().contains(&"place of the pixel, for the threshold"));
            let textures = scene.textures(&plan.setup.textures);
            let shot = hashed_alpha::render::draw::shot::shots(&scene)[0];
            let picture = |index: u32| {
                hashed_alpha::render::draw::frame::frame(&scene, &textures, &plan, &shot, index).picture
            };
            for index in [1, 5] {
                let later = picture(index + cycle.unwrap_or(3) as u32);
                assert_eq!(picture(index) == later, cycle.is_some(), "{effects}: {index}");
            }
            if cycle.is_some_and(|cycle| cycle > 1) {
                assert!(picture(1) != picture(2), "{effects}");
            }
        }
    }
}

/// One alpha everywhere, and a camera that goes on by half a pixel a frame, or by a whole one.
fn veil(step: f64) -> Study {
    let text = format!(
        "name = 'veil'\nresolution = [96, 96]\nframes = 5\n[camera]\neye = [0.3, 0.2, 5.0]\ntarget = [0.0, 0.0, 0.0]\n\
         motion = {{ translate = [{step}, 0.0] }}\n[[texture]]\nname = 't'\nconstant = {{ alpha = 0.5 }}\n[[surface]]\ntexture = 't'\n\
         card = {{ size = [8.0, 8.0] }}\n[[effects]]\nname = 'object'\nrobust = {{}}\n\
         [[effects]]\nname = 'screen'\nrobust = {{}}\ncoordinates = {{ space = 'screen' }}\n\
         [[effects]]\nname = 'mask'\nscreen_door = {{ mask = 'fixed' }}\n\
         [[effects]]\nname = 'moved'\nrobust = {{}}\njitter = {{ frames = 4 }}\n\
         [[effects]]\nname = 'mixed'\nrobust = {{}}\njitter = {{ frames = 4 }}\naverage = {{ frames = 4 }}\n"
    );
    drawn(&ready(read::read(&text, "veil.toml").unwrap_or_else(|error| panic!("{error}"))))
}

/// Noise that is locked to the screen never changes a pixel, and slides over the surface. Of a point that moves half a pixel a frame
/// half is compared with the same pixel and half with the next, of an alpha of one half that is a quarter; by a whole pixel, a half.
#[test]
fn noise_that_is_locked_to_the_screen_is_not_called_stable() {
    let numbers = |study: &Study, name: &str| {
        let take = study.takes.iter().find(|take| take.plan.name == name).expect("a take");
        ["flips.pixel", "flips.surface"].map(|number| take.metrics[number])
    };
    for (step, share) in [(0.5, 0.25), (1.0, 0.5)] {
        let study = veil(step);
        let [pixel, surface] = numbers(&study, "screen");
        assert!(pixel == 0.0 && (surface - share).abs() < 0.03, "{step}: {pixel} {surface}");
        let [pixel, surface] = numbers(&study, "object");
        assert!(pixel > 0.2, "{step}: {pixel}");
        // After a whole pixel every point is where a pixel has its middle again.
        assert!(
            if step == 1.0 { surface < 0.02 } else { (surface - pixel).abs() < 0.03 },
            "{step}: {pixel} {surface}"
        );
        let locked: Vec<&str> =
            study.notes.iter().map(|note| note.split(':').next().expect("a name")).collect();
        assert_eq!(locked, ["screen", "mask"], "{:?}", study.notes);
    }
    let still = veil(0.0);
    assert_eq!(still.notes, Vec::<String>::new());
    // Places are rounded to `f32`.
    let [pixel, surface] = numbers(&still, "object");
    assert!(pixel == 0.0 && surface < 1e-5, "{pixel} {surface}");
    // A camera that moves within the pixel is followed, until its images are mixed: the mixture stands still.
    let [pixel, surface] = numbers(&still, "moved");
    assert!(pixel > 0.05 && surface > 0.05 && surface != pixel, "{pixel} {surface}");
    let [pixel, surface] = numbers(&still, "mixed");
    assert!(pixel > 0.0 && (surface - pixel).abs() < 1e-3, "{pixel} {surface}");
}

/// Near, a card of sharp leaves is right under the alpha test; from afar it vanishes, and the planner looks there, too.
#[test]
fn the_planner_looks_from_every_distance() {
    let planned = |distance: &str| {
        let text = format!(
            "name = 'near'\neffects = 'auto'\nresolution = [128, 128]\n[camera]\neye = [0.1, 0.2, 2.0]\ntarget = [0.0, 0.0, 0.0]\n\
             [[texture]]\nname = 't'\nleaves = {{ count = 8, length = 0.3 }}\n[[surface]]\ntexture = 't'\n\
             card = {{ size = [1.4, 1.4] }}\n{distance}"
        );
        let scene = ready(read::read(&text, "near.toml").unwrap_or_else(|error| panic!("{error}")));
        let choice =
            hashed_alpha::render::measure::auto::choose(&scene, &scene.textures(&Default::default()));
        (choice.effects.fixed.is_some(), choice.reasons[0].clone())
    };
    let (fixed, reason) = planned("");
    assert!(fixed && !reason.contains("times the distance"), "{reason}");
    let (fixed, reason) = planned("[distance]\nfactors = [4.0, 40.0]");
    assert!(!fixed && reason.contains("from 40 times the distance"), "{reason}");
}
