//! Every technique that the sources name is shown by a take of the gallery, tested, and priced.

use hashed_alpha::cost::Effort;
use hashed_alpha::cost::techniques::{all, take, techniques, without};
use hashed_alpha::render::effect::kind::Technique;
use hashed_alpha::render::effect::plan::plan;
use hashed_alpha::render::effect::{ALL, Effects, Known};
use hashed_alpha::render::measure::predict::predict;
use hashed_alpha::render::measure::study::study;
use hashed_alpha::render::scene_file::load::prepare;
use hashed_alpha::render::scene_file::schema::{SceneFile, Takes};
use std::collections::{BTreeSet, HashSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Every technique of the sources: the module that computes it, and the test of what its source says of it, a test function
/// or a row of the page of sentences.
const TESTED: &[(&str, &str, &str)] = &[
    (
        "sharpened-alpha-to-coverage",
        "render::effect::sharpened",
        "a_linear_edge_becomes_one_pixel_wide_whatever_its_slope",
    ),
    ("fixed", "threshold::fixed", "problem.passing"),
    ("level-threshold", "technique::prior_work::level_threshold", "the_share_of_passing_texels_is_kept"),
    (
        "scaled-alpha",
        "technique::prior_work::scaled_alpha",
        "scaled_alphas_pass_as_under_the_threshold_of_their_level",
    ),
    (
        "interpolated-scaled-alpha",
        "render::effect::scaled_alpha",
        "interpolated_alpha_keeps_the_share_of_thin_strands",
    ),
    (
        "texel-threshold",
        "technique::prior_work::level_threshold",
        "a_factor_for_each_texel_passes_as_the_threshold_of_each_texel",
    ),
    (
        "finest-level",
        "technique::prior_work::finest_level",
        "the_finest_level_keeps_the_share_of_passing_texels",
    ),
    ("level-bias", "render::effect::level_bias", "a_bias_moves_the_level_and_a_limit_still_holds"),
    ("limited-level", "technique::prior_work::finest_level", "levels_up_to_the_limit_are_read_as_they_are"),
    (
        "naive-blend",
        "technique::prior_work::test_then_blend",
        "naive_blending_hides_an_opaque_fragment_behind_a_transparent_one",
    ),
    (
        "test-then-blend",
        "technique::prior_work::test_then_blend",
        "after_an_alpha_test_the_order_of_an_opaque_fragment_is_of_no_account",
    ),
    (
        "supersampling",
        "technique::prior_work::supersampling",
        "enough_samples_of_binary_alpha_are_the_filtered_alpha",
    ),
    ("sorted-blend", "technique::prior_work::test_then_blend", "the_truth_moves_as_the_takes_do"),
    ("stochastic", "threshold::stochastic", "expected_visibility_is_alpha"),
    ("stochastic-transparency", "threshold::stochastic", "transparency.converges"),
    ("single-scale", "threshold::two_scale::single", "zoom.single"),
    ("linear-scales", "threshold::two_scale::linear", "zoom.linear"),
    ("hashed-isotropic", "threshold::two_scale::isotropic", "results.stability"),
    ("hashed-anisotropic", "threshold::two_scale::anisotropic", "grazing.elongated"),
    ("robust", "threshold::robust", "no_derivative_at_all_still_gives_a_threshold"),
    ("fade-in", "threshold::stage::fade_in", "the_ramp_is_quadratic_between_its_ends"),
    ("anisotropy-factor", "threshold::stage::fade_in", "fade.anisotropy"),
    ("blend-towards", "threshold::stage::fade_in", "without_noise_the_authored_threshold_decides"),
    (
        "noise-scale",
        "technique::noise_scale",
        "eight_samples_meet_eight_cells_of_one_octave_at_the_ends_only",
    ),
    ("independent-hashes", "threshold::stage::independent", "frames_do_not_correlate_in_a_cell"),
    ("frame-word", "threshold::stage::independent", "frame_0_is_the_hash_itself_and_the_sine_sees_no_frame"),
    ("stratified-frames", "threshold::stage::stratify", "temporal.ascending"),
    ("alternating-order", "threshold::stage::order", "the_orders_flicker_as_ranked"),
    ("van-der-corput", "threshold::stage::order", "temporal.van_der_corput"),
    (
        "phase-rotated",
        "threshold::stage::order",
        "only_the_phase_rotated_orders_alternate_for_every_hash_value",
    ),
    ("camera-jitter", "technique::jitter", "eight_frames_spread_over_the_pixel"),
    ("temporal-antialiasing", "technique::history", "what_vanished_is_forgotten_in_the_time_said"),
    ("reprojected-history", "technique::history", "surfaces_are_found_where_they_were"),
    ("premultiplied-alpha", "technique::premultiplied", "a_halo_appears_without_premultiplied_alpha_only"),
    (
        "multisampling",
        "technique::multisampling",
        "triangles_that_share_edges_share_no_sample_and_cover_what_finer_pixels_do",
    ),
    ("alpha-to-coverage", "threshold::stage::coverage", "coverage.fixed_layers"),
    (
        "hardware-alpha-to-coverage",
        "threshold::stage::coverage",
        "a_single_layer_covers_alpha_but_for_what_rounding_takes",
    ),
    ("jittered-alpha-to-coverage", "threshold::stage::coverage", "coverage.jittered"),
    (
        "permuted-alpha-to-coverage",
        "threshold::stage::coverage",
        "only_masks_of_their_own_make_layers_multiply",
    ),
    ("random-masks", "threshold::stage::coverage", "random_sets_are_evenly_drawn"),
    ("pixel-masks", "threshold::stage::coverage", "pixels_get_patterns_of_their_own"),
    ("screen-door", "threshold::stage::screen_door", "screen_door.masks"),
    ("bayer-screen-door", "threshold::stage::screen_door", "the_larger_dither_is_that_of_bayer"),
    (
        "random-screen-door",
        "threshold::stage::screen_door",
        "fixed_and_random_masks_repeat_from_tile_to_tile",
    ),
    ("hashed-screen-door", "threshold::stage::screen_door", "only_tiles_of_their_own_make_layers_multiply"),
    ("stipple", "threshold::stage::stipple", "stipple.one_layer"),
    ("conservative", "technique::conservative", "corrected_thresholds_keep_the_area_of_cards_below_a_pixel"),
    ("hashed-occlusion", "technique::occlusion", "one_ray_a_pixel_gives_the_occlusion_in_the_mean"),
    ("hash-seeded-generator", "technique::occlusion", "a_cell_seeds_one_stream"),
    ("foveated", "technique::foveated", "the_periphery_loses_its_foliage_under_a_fixed_test_only"),
];

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

fn file(module: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(module.replace("::", "/"));
    [path.with_extension("rs"), path.join("mod.rs")].into_iter().find(|path| path.is_file())
}

/// What a technique lacks, if anything.
fn missing(effect: Option<&Known>, technique: &Technique) -> Option<String> {
    let [scene, name] = technique.shown;
    let Some((file, set)) = take(scene, name) else {
        return Some(format!("no take `{name}` in the scene `{scene}`"));
    };
    if !TESTED.iter().any(|(tested, ..)| *tested == technique.name) {
        return Some("no test".to_owned());
    }
    let has = effect.map_or(file.truth.is_some(), |effect| effect.is_in(&set));
    (!has).then(|| "not in its take".to_owned())
}

#[test]
fn every_technique_has_a_scene_a_test_and_a_price() {
    let lacking: Vec<(&str, String)> =
        all().filter_map(|(effect, technique)| Some((technique.name, missing(effect, technique)?))).collect();
    assert!(lacking.is_empty(), "{lacking:#?}");
    let shown: BTreeSet<&str> = all().map(|(_, technique)| technique.name).collect();
    let tested: BTreeSet<&str> = TESTED.iter().map(|(name, ..)| *name).collect();
    assert_eq!(shown, tested);
    assert_eq!((shown.len(), TESTED.len()), (all().count(), shown.len()));
    let tests = tests();
    for (name, module, test) in TESTED {
        assert!(file(module).is_some(), "{name}: no module {module}");
        assert!(tests.contains(*test), "{name}: no test {test}");
    }
    for (_, technique) in all() {
        assert!(technique.name.bytes().all(|b| b.is_ascii_lowercase() || b == b'-'), "{technique:?}");
        assert!(!technique.source.is_empty() && technique.claim.ends_with('.'), "{technique:?}");
    }
}

#[test]
fn every_file_of_the_wing_is_the_module_of_a_technique() {
    let listed: Vec<PathBuf> = TESTED.iter().filter_map(|(_, module, _)| file(module)).collect();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/technique");
    for folder in [folder.clone(), folder.join("prior_work")] {
        for entry in fs::read_dir(folder).expect("the folder exists") {
            let path = entry.expect("an entry").path();
            let is_room = path.is_dir() || path.ends_with("mod.rs");
            assert!(is_room || listed.contains(&path), "{} is not listed", path.display());
        }
    }
}

#[test]
fn an_entry_that_names_what_does_not_exist_is_found() {
    let (effect, sound) = all().find(|(_, technique)| technique.name == "fade-in").expect("in the list");
    assert_eq!(missing(effect, sound), None);
    let other = ALL.iter().find(|known| known.name == "jitter");
    for (effect, broken) in [
        (effect, Technique { shown: ["fade-out", sound.shown[1]], ..*sound }),
        (effect, Technique { shown: [sound.shown[0], "faded"], ..*sound }),
        (effect, Technique { name: "fade-out", ..*sound }),
        (other, *sound),
        (None, Technique { shown: ["octaves", "linear"], ..*sound }),
    ] {
        assert!(missing(effect, &broken).is_some(), "{broken:?}");
    }
}

#[test]
fn every_technique_is_on_the_price_list() {
    let prices = techniques(Effort::Quick, &|| ());
    let names: Vec<&str> = prices.iter().map(|price| price.technique.name).collect();
    assert_eq!(names.len(), all().count(), "{names:?}");
    for price in prices {
        assert!(price.with > 0.0 && price.without > 0.0, "{}", price.technique.name);
    }
    // What something else needs is not taken away alone.
    let (_, set) = take("temporal-orders", "ascending, 8").expect("in the gallery");
    let known = |name: &str| ALL.iter().find(|known| known.name == name).expect("an effect");
    assert_eq!(without(&set, known("robust")), Effects::default());
    assert!(without(&set, known("temporal")).robust.is_some());
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
            let known = ALL.iter().find(|known| known.name == *table).expect("an effect");
            assert!(known.is_in(&set), "{name}: {table}");
        }
        let frames = 3.try_into().expect("not zero");
        let sets = Takes::Sets(vec![set.clone()]);
        let file = SceneFile { frames, effects: sets, truth: None, expect: Vec::new(), ..file };
        let scene = prepare(file, Path::new("")).expect("built-in textures");
        let plan = plan(&set);
        let predicted = predict(&plan, &scene, &scene.textures(&plan.setup.textures), &mut || ());
        let counted = study(&scene, &mut |_, _| ()).takes[0].cost;
        assert_eq!(counted, predicted, "{name}");
        let (fragments, pixels) = (counted.fragments, 3 * 96 * 96);
        let samples = if set.alpha_to_coverage.is_some() { 8 } else { 1 };
        assert_eq!((counted.tests, counted.blends), (samples * fragments, pixels), "{name}");
        // Eq. 9 takes one hash more; the copula of the anisotropic threshold takes eight.
        assert_eq!(counted.hashes, if samples == 8 { 3 } else { 8 } * fragments, "{name}");
    }
}
