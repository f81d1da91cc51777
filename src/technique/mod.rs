//! What the sources compare with or build upon the hashed threshold: one file a technique, pure functions over numbers.
//!
//! Each file cites its source, computes literally what that says, and tests the sentence that the source says of it.
//! [`ALL`] lists every technique that the sources name, those of [`threshold`](crate::threshold) among them.
//!
//! What never lives here: scenes, pictures, files, statistics.

pub mod conservative;
pub mod foveated;
pub mod history;
pub mod jitter;
pub mod multisampling;
pub mod noise_scale;
pub mod occlusion;
pub mod premultiplied;
pub mod prior_work;

/// A technique that the sources name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Technique {
    /// What it is called here: words joined by hyphens.
    pub name: &'static str,
    /// Where the sources describe it, as in "§7.1, Eqs. 3-5"; a paragraph alone is one of the journal version.
    pub source: &'static str,
    /// What the source, or where it says "not in the paper" this crate, says of it.
    pub claim: &'static str,
    /// The module of this crate that computes it.
    pub module: &'static str,
    /// The scene of the gallery that shows it.
    pub scene: &'static str,
    /// The take of that scene.
    pub take: &'static str,
    /// The table of the take that is its price: the price list draws the take with and without; [`TRUTH`] for the
    /// scene's ground truth.
    pub price: &'static str,
    /// The test of its claim: a test function, or a row of the page of claims.
    pub test: &'static str,
}

/// The price of what is drawn beside all takes.
pub const TRUTH: &str = "truth";

const fn technique(
    name: &'static str,
    source: &'static str,
    module: &'static str,
    claim: &'static str,
) -> Technique {
    Technique { name, source, claim, module, scene: "", take: "", price: "", test: "" }
}

impl Technique {
    const fn seen(self, scene: &'static str, take: &'static str, price: &'static str) -> Self {
        Self { scene, take, price, ..self }
    }

    const fn tested(self, test: &'static str) -> Self {
        Self { test, ..self }
    }
}

/// Every technique that the sources name, in the order of the paper.
pub const ALL: &[Technique] = &[
    technique(
        "fixed",
        "§1",
        "threshold::fixed",
        "Geometry vanishes with distance where the mean alpha is below the threshold.",
    )
    .seen("vanishing-foliage", "alpha test", "fixed")
    .tested("problem.passing"),
    technique(
        "level-threshold",
        "§3, Eq. 1",
        "technique::prior_work::level_threshold",
        "A threshold for each level keeps the share of passing texels; geometry can still vanish.",
    )
    .seen("mips-and-wires", "a threshold a level", "level_threshold")
    .tested("the_share_of_passing_texels_is_kept"),
    technique(
        "scaled-alpha",
        "§3 (Castano 2010)",
        "technique::prior_work::scaled_alpha",
        "Scaled alphas are equivalent to a threshold for each level, and dilate thin geometry.",
    )
    .seen("castano", "scaled alpha", "scaled_alpha")
    .tested("scaled_alphas_pass_as_under_the_threshold_of_their_level"),
    technique(
        "texel-threshold",
        "§3",
        "technique::prior_work::level_threshold",
        "A threshold for each texel needs a rule that is not obvious, and may only dilate boundaries.",
    )
    .seen("castano", "scaled texels", "scaled_texels")
    .tested("a_factor_for_each_texel_passes_as_the_threshold_of_each_texel"),
    technique(
        "finest-level",
        "§3",
        "technique::prior_work::finest_level",
        "Alpha from the finest level keeps its variance, and costs a second fetch and temporal stability.",
    )
    .seen("mips-and-wires", "finest level", "finest_level")
    .tested("the_finest_level_keeps_the_share_of_passing_texels"),
    technique(
        "limited-level",
        "§3",
        "technique::prior_work::finest_level",
        "Levels beyond a limit are not read; the cost is that of the finest level, put off.",
    )
    .seen("mips-and-wires", "no coarser than level 3", "limited_level")
    .tested("levels_up_to_the_limit_are_read_as_they_are"),
    technique(
        "naive-blend",
        "§3",
        "technique::prior_work::test_then_blend",
        "Blending in any order with depth writes leaves halos.",
    )
    .seen("blending", "naive blend", "naive_blend")
    .tested("naive_blending_hides_an_opaque_fragment_behind_a_transparent_one"),
    technique(
        "test-then-blend",
        "§3 (Moore & Jefferies 2009)",
        "technique::prior_work::test_then_blend",
        "Transparent fragments never hide opaque ones; everything is drawn twice.",
    )
    .seen("blending", "test, then blend", "test_then_blend")
    .tested("after_an_alpha_test_the_order_of_an_opaque_fragment_is_of_no_account"),
    technique(
        "supersampling",
        "§3",
        "technique::prior_work::supersampling",
        "Enough samples of binary alpha give accurate visibility; the number needed has no bound.",
    )
    .seen("blending", "supersampled", "supersampling")
    .tested("enough_samples_of_binary_alpha_are_the_filtered_alpha"),
    technique(
        "sorted-blend",
        "§4, Fig. 5",
        "technique::prior_work::test_then_blend",
        "The ground truth to which many stochastic samples converge.",
    )
    .seen("samples-converge", "64 samples", TRUTH)
    .tested("the_truth_moves_as_the_takes_do"),
    technique(
        "stochastic",
        "§4",
        "threshold::stochastic",
        "The expected visibility is alpha; every frame flickers.",
    )
    .seen("subpixel-motion", "stochastic", "stochastic")
    .tested("expected_visibility_is_alpha"),
    technique(
        "stochastic-transparency",
        "§10 (Enderton et al. 2010)",
        "threshold::stochastic",
        "More random tests a pixel converge to ground truth.",
    )
    .seen("samples-converge", "64 samples", "alpha_to_coverage")
    .tested("transparency.converges"),
    technique(
        "single-scale",
        "§5.4.1",
        "threshold::two_scale::single",
        "Noise of one pixel is stable under shifts within a pixel, and not along the view.",
    )
    .seen("octaves", "one scale", "hashed")
    .tested("zoom.single"),
    technique(
        "linear-scales",
        "§5.4.2",
        "threshold::two_scale::linear",
        "Two linear scales change slowly, and fail for derivatives below one.",
    )
    .seen("octaves", "linear", "hashed")
    .tested("zoom.linear"),
    technique(
        "hashed-isotropic",
        "§5, Listing 1",
        "threshold::two_scale::isotropic",
        "Coverage of stochastic alpha testing, stability of the traditional test.",
    )
    .seen("vanishing-foliage", "hashed", "hashed")
    .tested("results.stability"),
    technique(
        "hashed-anisotropic",
        "§6, Listing 2",
        "threshold::two_scale::anisotropic",
        "Noise keeps the size of a pixel along both screen axes at grazing angles.",
    )
    .seen("grazing-fence", "anisotropic", "hashed")
    .tested("grazing.elongated"),
    technique(
        "robust",
        "not in the paper",
        "threshold::robust",
        "The listings with every repair: a threshold for every input, without jumps.",
    )
    .seen("axis-plane", "robust anisotropic", "robust")
    .tested("no_derivative_at_all_still_gives_a_threshold"),
    technique(
        "fade-in",
        "§7.1, Eqs. 3-5",
        "threshold::stage::fade_in",
        "Noise fades in with distance, near surfaces stay crisp.",
    )
    .seen("fade-in", "faded in", "fade_in")
    .tested("the_ramp_is_quadratic_between_its_ends"),
    technique(
        "anisotropy-factor",
        "§7.1.1",
        "threshold::stage::fade_in",
        "Noise fades in earlier at grazing angles, where fine levels are read.",
    )
    .seen("grazing-fence", "faded in by anisotropy", "fade_in")
    .tested("fade.anisotropy"),
    technique(
        "blend-towards",
        "not in the paper",
        "threshold::stage::fade_in",
        "Noise fades in from a threshold of the artist's.",
    )
    .seen("fade-in", "faded in from 0.25", "fade_in")
    .tested("without_noise_the_authored_threshold_decides"),
    technique(
        "noise-scale",
        "§7.2.1",
        "technique::noise_scale",
        "Noise of sqrt(1/n) pixels holds n values a pixel, and is less stable.",
    )
    .seen("temporal-noise", "noise of sqrt(1/8) pixels", "robust")
    .tested("eight_samples_meet_eight_cells_of_one_octave_at_the_ends_only"),
    technique(
        "independent-hashes",
        "§7.2.2",
        "threshold::stage::independent",
        "Offsets in hash space give independent thresholds for each frame; the average flickers.",
    )
    .seen("temporal-orders", "independent, 8", "independent")
    .tested("frames_do_not_correlate_in_a_cell"),
    technique(
        "frame-word",
        "not in the paper",
        "threshold::stage::independent",
        "The same by a word that the hash reads.",
    )
    .seen("temporal-orders", "word, 8", "independent")
    .tested("frame_0_is_the_hash_itself_and_the_sine_sees_no_frame"),
    technique(
        "stratified-frames",
        "§7.2.3, Eq. 6",
        "threshold::stage::stratify",
        "One hash gives n frames a stratum each; in ascending order the average flickers.",
    )
    .seen("temporal-orders", "ascending, 8", "temporal")
    .tested("temporal.ascending"),
    technique(
        "alternating-order",
        "§7.2.3",
        "threshold::stage::order",
        "Every other threshold is below one half, and the average flickers less.",
    )
    .seen("temporal-orders", "alternating, 8", "temporal")
    .tested("the_orders_flicker_as_ranked"),
    technique("van-der-corput", "§7.2.3", "threshold::stage::order", "A low-discrepancy order is better still.")
        .seen("temporal-orders", "van-der-corput, 8", "temporal")
        .tested("temporal.van_der_corput"),
    technique(
        "phase-rotated",
        "not in the paper",
        "threshold::stage::order",
        "The order is entered at the stratum of the hash, and alternates for every hash value.",
    )
    .seen("temporal-orders", "phase-rotated, 8", "temporal")
    .tested("only_the_phase_rotated_orders_alternate_for_every_hash_value"),
    technique(
        "camera-jitter",
        "§7.2",
        "technique::jitter",
        "Averaged frames see different places within a pixel.",
    )
    .seen("temporal-noise", "noise of 1 pixel", "jitter")
    .tested("eight_frames_spread_over_the_pixel"),
    technique(
        "temporal-antialiasing",
        "§7.2 (Karis 2014)",
        "technique::history",
        "An exponential average weighs the latest frames most.",
    )
    .seen("temporal-ghosts", "phase-rotated", "history")
    .tested("what_vanished_is_forgotten_in_the_time_said"),
    technique(
        "reprojected-history",
        "§7.2 (Karis 2014)",
        "technique::history",
        "The average is looked up where the motion of the camera has left it, and follows surfaces; what they uncover keeps a ghost.",
    )
    .seen("temporal-ghosts", "phase-rotated, reprojected", "history")
    .tested("surfaces_are_found_where_they_were"),
    technique(
        "premultiplied-alpha",
        "§7.3",
        "technique::premultiplied",
        "Premultiplied colours leave no halo and need a divide.",
    )
    .seen("halo", "premultiplied", "premultiplied")
    .tested("a_halo_appears_without_premultiplied_alpha_only"),
    technique(
        "multisampling",
        "§1, §2, §8",
        "technique::multisampling",
        "Edges of geometry are smoothed; edges of alpha, which is read once a pixel, are not.",
    )
    .seen("multisample", "multisampled test", "multisampling")
    .tested("triangles_that_share_edges_share_no_sample_and_cover_what_finer_pixels_do"),
    technique(
        "alpha-to-coverage",
        "§8, Eq. 7",
        "threshold::stage::coverage",
        "n regular tests in a pixel; layers of equal alpha cover the same samples.",
    )
    .seen("vanishing-foliage", "alpha to coverage", "alpha_to_coverage")
    .tested("coverage.fixed_layers"),
    technique(
        "hardware-alpha-to-coverage",
        "§3, §8",
        "threshold::stage::coverage",
        "floor(n alpha) samples in a fixed pattern.",
    )
    .seen("multisample", "as hardware", "alpha_to_coverage")
    .tested("a_single_layer_covers_alpha_but_for_what_rounding_takes"),
    technique(
        "jittered-alpha-to-coverage",
        "§8, Eq. 8",
        "threshold::stage::coverage",
        "Thresholds jittered within their strata; layers still share samples.",
    )
    .seen("checkerboard", "isotropic to coverage", "alpha_to_coverage")
    .tested("coverage.jittered"),
    technique(
        "permuted-alpha-to-coverage",
        "§8, Eq. 9",
        "threshold::stage::coverage",
        "Strata permuted for each fragment; layers multiply.",
    )
    .seen("vanishing-foliage", "hashed to coverage", "alpha_to_coverage")
    .tested("only_masks_of_their_own_make_layers_multiply"),
    technique(
        "random-masks",
        "§3 (Enderton et al. 2010)",
        "threshold::stage::coverage",
        "Random sets of samples; layers multiply.",
    )
    .seen("layers", "hashed, random", "alpha_to_coverage")
    .tested("random_sets_are_evenly_drawn"),
    technique(
        "pixel-masks",
        "Humus 2009",
        "threshold::stage::coverage",
        "A pseudo-random value of the pixel breaks up the repetitive dither of hardware.",
    )
    .seen("pixel-masks", "by pixel", "alpha_to_coverage")
    .tested("pixels_get_patterns_of_their_own"),
    technique(
        "screen-door",
        "§3, §8.1",
        "threshold::stage::screen_door",
        "Samples lie in several pixels; layers and tiles repeat.",
    )
    .seen("screen-door", "fixed mask", "screen_door")
    .tested("screen_door.masks"),
    technique(
        "random-screen-door",
        "§3 (Mulder et al. 1998)",
        "threshold::stage::screen_door",
        "Even a random mask correlates layers.",
    )
    .seen("screen-door", "random mask", "screen_door")
    .tested("fixed_and_random_masks_repeat_from_tile_to_tile"),
    technique(
        "hashed-screen-door",
        "§8.1",
        "threshold::stage::screen_door",
        "Permuted for each tile and layer, layers multiply.",
    )
    .seen("screen-door", "hashed masks", "screen_door")
    .tested("only_tiles_of_their_own_make_layers_multiply"),
    technique(
        "stipple",
        "Ols 2009",
        "threshold::stage::stipple",
        "One of four pixels is left out; only one layer of translucency is possible.",
    )
    .seen("stipple", "high density", "stipple")
    .tested("stipple.one_layer"),
    technique(
        "conservative",
        "§2, Fig. 4",
        "technique::conservative",
        "Every card draws; the threshold must allow for its share of the pixel.",
    )
    .seen("sub-pixel-cards", "touching, corrected", "conservative")
    .tested("corrected_thresholds_keep_the_area_of_cards_below_a_pixel"),
    technique(
        "hashed-occlusion",
        "§9, Fig. 8",
        "technique::occlusion",
        "One ray a pixel, with noise that stays fixed to the geometry.",
    )
    .seen("occlusion", "two hashes, anisotropic", "occlusion")
    .tested("one_ray_a_pixel_gives_the_occlusion_in_the_mean"),
    technique(
        "hash-seeded-generator",
        "§9",
        "technique::occlusion",
        "A hash that returns an integer seeds an ordinary generator.",
    )
    .seen("occlusion", "seeded", "occlusion")
    .tested("a_cell_seeds_one_stream"),
    technique(
        "foveated",
        "§11, Fig. 15 (Patney et al. 2016)",
        "technique::foveated",
        "Coarser levels away from the gaze lose foliage under a fixed test and keep it under a hashed one.",
    )
    .seen("foveated", "hashed, foveated", "foveated")
    .tested("the_periphery_loses_its_foliage_under_a_fixed_test_only"),
];

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn every_technique_has_a_name_a_source_a_sentence_and_a_file() {
        let mut names: Vec<_> = ALL.iter().map(|technique| technique.name).collect();
        names.sort_unstable();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]));
        for technique in ALL {
            let path =
                Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(technique.module.replace("::", "/"));
            assert!(path.with_extension("rs").is_file() || path.join("mod.rs").is_file(), "{technique:?}");
            assert!(technique.name.bytes().all(|b| b.is_ascii_lowercase() || b == b'-'), "{technique:?}");
            assert!(!technique.source.is_empty() && technique.claim.ends_with('.'), "{technique:?}");
        }
    }

    #[test]
    fn every_file_of_this_wing_is_listed() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/technique");
        for wing in ["", "prior_work"] {
            for entry in std::fs::read_dir(folder.join(wing)).expect("the folder exists") {
                let path = entry.expect("an entry").path();
                let name = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
                let listed = |t: &Technique| t.module.rsplit("::").next() == Some(name);
                assert!(
                    ["mod", "prior_work"].contains(&name) || ALL.iter().any(listed),
                    "{} is not listed",
                    path.display()
                );
            }
        }
    }
}
