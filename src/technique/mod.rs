//! What the sources compare with or build upon the hashed threshold: one file a technique, pure functions over numbers.
//!
//! Each file cites its source, computes literally what that says, and tests the sentence that the source says of it.
//! [`ALL`] lists every technique that the sources name, those of [`threshold`](crate::threshold) among them.
//!
//! What never lives here: scenes, pictures, files, statistics.

pub mod blend_towards;
pub mod conservative;
pub mod foveated;
pub mod history;
pub mod independent;
pub mod jitter;
pub mod mask;
pub mod multisampling;
pub mod noise_scale;
pub mod occlusion;
pub mod order;
pub mod premultiplied;
pub mod remedies;
pub mod screen_door;
pub mod stipple;

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
}

const fn technique(
    name: &'static str,
    source: &'static str,
    module: &'static str,
    claim: &'static str,
) -> Technique {
    Technique { name, source, claim, module }
}

/// Every technique that the sources name, in the order of the paper.
pub const ALL: &[Technique] = &[
    technique(
        "fixed",
        "§1",
        "threshold::fixed",
        "Geometry vanishes with distance where the mean alpha is below the threshold.",
    ),
    technique(
        "level-threshold",
        "§3, Eq. 1",
        "technique::remedies::level_threshold",
        "A threshold for each level keeps the share of passing texels; geometry can still vanish.",
    ),
    technique(
        "scaled-alpha",
        "§3 (Castano 2010)",
        "technique::remedies::scaled_alpha",
        "Scaled alphas are equivalent to a threshold for each level, and dilate thin geometry.",
    ),
    technique(
        "texel-threshold",
        "§3",
        "technique::remedies::level_threshold",
        "A threshold for each texel needs a rule that is not obvious, and may only dilate boundaries.",
    ),
    technique(
        "finest-level",
        "§3",
        "technique::remedies::finest_level",
        "Alpha from the finest level keeps its variance, and costs a second fetch and temporal stability.",
    ),
    technique(
        "limited-level",
        "§3",
        "technique::remedies::finest_level",
        "Levels beyond a limit are not read; the cost is that of the finest level, put off.",
    ),
    technique(
        "naive-blend",
        "§3",
        "technique::remedies::test_then_blend",
        "Blending in any order with depth writes leaves halos.",
    ),
    technique(
        "test-then-blend",
        "§3 (Moore & Jefferies 2009)",
        "technique::remedies::test_then_blend",
        "Transparent fragments never hide opaque ones; everything is drawn twice.",
    ),
    technique(
        "supersampling",
        "§3",
        "technique::remedies::supersampling",
        "Enough samples of binary alpha give accurate visibility; the number needed has no bound.",
    ),
    technique(
        "sorted-blend",
        "§4, Fig. 5",
        "technique::remedies::test_then_blend",
        "The ground truth to which many stochastic samples converge.",
    ),
    technique(
        "stochastic",
        "§4",
        "threshold::stochastic",
        "The expected visibility is alpha; every frame flickers.",
    ),
    technique(
        "stochastic-transparency",
        "§10 (Enderton et al. 2010)",
        "threshold::stochastic",
        "More random tests a pixel converge to ground truth.",
    ),
    technique(
        "single-scale",
        "§5.4.1",
        "threshold::two_scale::single",
        "Noise of one pixel is stable under shifts within a pixel, and not along the view.",
    ),
    technique(
        "linear-scales",
        "§5.4.2",
        "threshold::two_scale::linear",
        "Two linear scales change slowly, and fail for derivatives below one.",
    ),
    technique(
        "hashed-isotropic",
        "§5, Listing 1",
        "threshold::two_scale::isotropic",
        "Coverage of stochastic alpha testing, stability of the traditional test.",
    ),
    technique(
        "hashed-anisotropic",
        "§6, Listing 2",
        "threshold::two_scale::anisotropic",
        "Noise keeps the size of a pixel along both screen axes at grazing angles.",
    ),
    technique(
        "robust",
        "not in the paper",
        "threshold::robust",
        "The listings with every repair: a threshold for every input, without jumps.",
    ),
    technique(
        "fade-in",
        "§7.1, Eqs. 3-5",
        "threshold::fade_in",
        "Noise fades in with distance, near surfaces stay crisp.",
    ),
    technique(
        "anisotropy-factor",
        "§7.1.1",
        "threshold::fade_in",
        "Noise fades in earlier at grazing angles, where fine levels are read.",
    ),
    technique(
        "blend-towards",
        "not in the paper",
        "technique::blend_towards",
        "Noise fades in from a threshold of the artist's.",
    ),
    technique(
        "noise-scale",
        "§7.2.1",
        "technique::noise_scale",
        "Noise of sqrt(1/n) pixels holds n values a pixel, and is less stable.",
    ),
    technique(
        "independent-hashes",
        "§7.2.2",
        "technique::independent",
        "Offsets in hash space give independent thresholds for each frame; the average flickers.",
    ),
    technique(
        "frame-word",
        "not in the paper",
        "technique::independent",
        "The same by a word that the hash reads.",
    ),
    technique(
        "stratified-frames",
        "§7.2.3, Eq. 6",
        "threshold::stratify",
        "One hash gives n frames a stratum each; in ascending order the average flickers.",
    ),
    technique(
        "alternating-order",
        "§7.2.3",
        "technique::order",
        "Every other threshold is below one half, and the average flickers less.",
    ),
    technique("van-der-corput", "§7.2.3", "technique::order", "A low-discrepancy order is better still."),
    technique(
        "phase-rotated",
        "not in the paper",
        "technique::order",
        "The order is entered at the stratum of the hash, and alternates for every hash value.",
    ),
    technique(
        "camera-jitter",
        "§7.2",
        "technique::jitter",
        "Averaged frames see different places within a pixel.",
    ),
    technique(
        "temporal-antialiasing",
        "§7.2 (Karis 2014)",
        "technique::history",
        "An exponential average weighs the latest frames most.",
    ),
    technique(
        "premultiplied-alpha",
        "§7.3",
        "technique::premultiplied",
        "Premultiplied colours leave no halo and need a divide.",
    ),
    technique(
        "multisampling",
        "§1, §2, §8",
        "technique::multisampling",
        "Edges of geometry are smoothed; edges of alpha, which is read once a pixel, are not.",
    ),
    technique(
        "alpha-to-coverage",
        "§8, Eq. 7",
        "technique::mask",
        "n regular tests in a pixel; layers of equal alpha cover the same samples.",
    ),
    technique(
        "hardware-alpha-to-coverage",
        "§3, §8",
        "technique::mask",
        "floor(n alpha) samples in a fixed pattern.",
    ),
    technique(
        "jittered-alpha-to-coverage",
        "§8, Eq. 8",
        "technique::mask",
        "Thresholds jittered within their strata; layers still share samples.",
    ),
    technique(
        "permuted-alpha-to-coverage",
        "§8, Eq. 9",
        "technique::mask",
        "Strata permuted for each fragment; layers multiply.",
    ),
    technique(
        "random-masks",
        "§3 (Enderton et al. 2010)",
        "technique::mask",
        "Random sets of samples; layers multiply.",
    ),
    technique(
        "pixel-masks",
        "Humus 2009",
        "technique::mask",
        "A pseudo-random value of the pixel breaks up the repetitive dither of hardware.",
    ),
    technique(
        "screen-door",
        "§3, §8.1",
        "technique::screen_door",
        "Samples lie in several pixels; layers and tiles repeat.",
    ),
    technique(
        "random-screen-door",
        "§3 (Mulder et al. 1998)",
        "technique::screen_door",
        "Even a random mask correlates layers.",
    ),
    technique(
        "hashed-screen-door",
        "§8.1",
        "technique::screen_door",
        "Permuted for each tile and layer, layers multiply.",
    ),
    technique(
        "stipple",
        "Ols 2009",
        "technique::stipple",
        "One of four pixels is left out; only one layer of translucency is possible.",
    ),
    technique(
        "conservative",
        "§2, Fig. 4",
        "technique::conservative",
        "Every card draws; the threshold must allow for its share of the pixel.",
    ),
    technique(
        "hashed-occlusion",
        "§9, Fig. 8",
        "technique::occlusion",
        "One ray a pixel, with noise that stays fixed to the geometry.",
    ),
    technique(
        "hash-seeded-generator",
        "§9",
        "technique::occlusion",
        "A hash that returns an integer seeds an ordinary generator.",
    ),
    technique(
        "foveated",
        "§11, Fig. 15 (Patney et al. 2016)",
        "technique::foveated",
        "Coarser levels away from the gaze lose foliage under a fixed test and keep it under a hashed one.",
    ),
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
        for wing in ["", "remedies"] {
            for entry in std::fs::read_dir(folder.join(wing)).expect("the folder exists") {
                let path = entry.expect("an entry").path();
                let name = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
                let listed = |t: &Technique| t.module.rsplit("::").next() == Some(name);
                assert!(
                    ["mod", "remedies"].contains(&name) || ALL.iter().any(listed),
                    "{} is not listed",
                    path.display()
                );
            }
        }
    }
}
