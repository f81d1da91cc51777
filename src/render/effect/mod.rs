//! The effects that a scene can call for: one optional table each. Present means simulated, absent means that nothing of
//! it exists.

pub mod stage;
pub mod tables;

use crate::render::effect::tables::{
    AlphaToCoverage, Apart, Average, Conservative, Coordinates, FadeIn, FinestLevel, Fixed, Foveated, Hashed,
    History, Independent, Jitter, LevelThreshold, LimitedLevel, Multisampling, NaiveBlend, Occlusion,
    Pattern, Premultiplied, RobustHash, ScaledAlpha, ScaledTexels, ScreenDoor, Stipple, Stochastic,
    Supersampling, Temporal, TestThenBlend,
};
use crate::threshold::hash::HashKind;
use crate::threshold::two_scale::Variant;
use serde::Deserialize;

/// What is known of an effect without looking at a scene.
#[derive(Clone, Copy)]
pub struct Known {
    /// The name of its table.
    pub name: &'static str,
    /// Its place in the sources.
    pub citation: &'static str,
    /// What it does, in a line.
    pub does: &'static str,
    /// What it costs, in the quantities that are counted.
    pub costs: &'static str,
    /// Whether a set of effects has it.
    pub is_in: fn(&Effects) -> bool,
    /// Takes it out of a set.
    pub remove: fn(&mut Effects),
}

/// Declares the struct of tables and the list that tests, pages and `explain` walk.
macro_rules! effects {
    ($($field:ident: $table:ty, $citation:literal, $does:literal, $costs:literal;)*) => {
        /// The effects of one take of a scene; the order is that of the list of known effects.
        #[derive(Clone, Debug, Default, PartialEq, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub struct Effects {
            /// What the take is called in pictures and tables.
            pub name: Option<String>,
            $(
                #[doc = concat!($does, ". ", $citation, ".")]
                pub $field: Option<$table>,
            )*
        }

        /// Every effect, in the order in which they act.
        pub const ALL: &[Known] = &[$(
            Known {
                name: stringify!($field),
                citation: $citation,
                does: $does,
                costs: $costs,
                is_in: |effects| effects.$field.is_some(),
                remove: |effects| effects.$field = None,
            },
        )*];
    };
}

effects! {
    supersampling: Supersampling, "§3", "Tests at several places of each pixel and averages",
        "fragments and all that follows, samples^2 times";
    conservative: Conservative, "§2, Fig. 4", "Draws every pixel that a surface touches, and corrects the threshold by the share that it covers",
        "fragments: one for every pixel and triangle that touch";
    premultiplied: Premultiplied, "§7.3", "Stores colours multiplied by alpha and divides after filtering",
        "a division a shaded sample";
    finest_level: FinestLevel, "§3", "Reads alpha from the finest level, however far the surface",
        "texels: as many, but far apart";
    limited_level: LimitedLevel, "§3", "Reads alpha from no level coarser than a given one",
        "texels: as many, but further apart";
    foveated: Foveated, "§11, Fig. 15 (Patney et al. 2016)", "Reads coarser levels away from where the viewer looks",
        "nothing: texels as many, but nearer together";
    level_threshold: LevelThreshold, "§3, Eq. 1", "Compares with a threshold for each level, so that all pass the share of the finest",
        "nothing but the test; a pass over the texture beforehand";
    scaled_alpha: ScaledAlpha, "§3 (Castano 2010)", "Scales the stored alphas of each level to that effect",
        "nothing; a pass over the texture beforehand";
    scaled_texels: ScaledTexels, "§3", "Scales each stored alpha by the share of the texels around it",
        "nothing; passes over the texture beforehand";
    fixed: Fixed, "§1", "Compares alpha with one threshold", "nothing but the test";
    stochastic: Stochastic, "§4", "Draws a threshold anew in every fragment and frame", "random numbers: 1 a threshold";
    hashed: Hashed, "§5, §6, Listings 1 and 2", "Hashes a threshold from the place on the surface, to the letter",
        "hashes: 2 a fragment (1 for the single scale)";
    robust: RobustHash, "not in the paper", "Hashes a threshold with every repair",
        "hashes: 2 to 8 a fragment, by join and variant";
    screen_door: ScreenDoor, "§3, §8.1", "Compares with thresholds that lie over tiles of pixels",
        "hashes: 3 a fragment if hashed";
    stipple: Stipple, "Ols 2009", "Leaves out one pixel of four, or three, wherever a surface is not opaque", "nothing";
    coordinates: Coordinates, "§5.2, §5.3", "Hashes in other than object coordinates", "nothing";
    independent: Independent, "§7.2.2", "Hashes at another place in every frame", "nothing but an addition a hash";
    jitter: Jitter, "§7.2", "Moves the camera within a pixel from frame to frame", "nothing";
    temporal: Temporal, "§7.2.3, Eq. 6", "Divides the range of thresholds among frames", "nothing but an addition";
    multisampling: Multisampling, "§1, §2, §8", "Tests geometry at several places of each pixel, and reads alpha once",
        "fragments: one for every pixel and triangle that meet in a sample";
    alpha_to_coverage: AlphaToCoverage, "§3, §8, Eqs. 7 to 9, Humus 2009", "Tests alpha at every sample of a pixel",
        "tests: samples a fragment; hashes: 1 more a fragment if decorrelated, random or by pixel";
    fade_in: FadeIn, "§7.1, Eqs. 3 to 5", "Fades noise in with distance", "nothing but a mixture";
    naive_blend: NaiveBlend, "§3", "Blends every fragment as it comes, with depth and without a test",
        "blends: 1 a fragment; no tests";
    test_then_blend: TestThenBlend, "§3 (Moore & Jefferies 2009)", "Draws what fails the test once more, blended",
        "passes, fragments, texels: twice; blends: 1 a fragment";
    occlusion: Occlusion, "§9, Fig. 8", "Traces one ray a pixel into the open, in a direction that stays with the surface",
        "rays: 1 for each pixel that shows a surface; hashes or random numbers: 2 values a ray";
    history: History, "§7.2 (Karis 2014)", "Averages frames exponentially, as temporal antialiasing does",
        "blends: 1 a pixel and frame; projections: 1 a pixel and frame if reprojected";
    average: Average, "§7.2", "Averages frames, as temporal antialiasing does", "samples: one blend a pixel and frame";
}

/// Says what is wrong with a set of effects.
///
/// # Errors
///
/// Two thresholds where one is meant, and effects that need another one. Numbers are checked as they are read.
pub fn check(effects: &Effects) -> Result<(), String> {
    let sources = [
        ("fixed", effects.fixed.is_some()),
        ("level_threshold", effects.level_threshold.is_some()),
        ("stochastic", effects.stochastic.is_some()),
        ("hashed", effects.hashed.is_some()),
        ("robust", effects.robust.is_some()),
        ("screen_door", effects.screen_door.is_some()),
    ];
    let sources: Vec<&str> = sources.iter().filter(|(_, present)| *present).map(|(name, _)| *name).collect();
    if sources.len() > 1 {
        return Err(format!("effects choose the threshold by {} at once; keep one", sources.join(" and ")));
    }
    if effects.naive_blend.is_some() {
        let others = [
            ("alpha_to_coverage", effects.alpha_to_coverage.is_some()),
            ("conservative", effects.conservative.is_some()),
            ("multisampling", effects.multisampling.is_some()),
            ("stipple", effects.stipple.is_some()),
            ("occlusion", effects.occlusion.is_some()),
            ("test_then_blend", effects.test_then_blend.is_some()),
        ];
        let mut others = others.iter().filter(|(_, present)| *present).map(|(name, _)| *name);
        if let Some(other) = others.next().or(sources.first().copied()) {
            return Err(format!("`naive_blend` tests nothing and `{other}` does; keep one"));
        }
        if effects.history.as_ref().is_some_and(|history| history.reproject) {
            return Err(
                "`history.reproject` needs one depth a pixel and `naive_blend` shows several; keep one"
                    .to_owned(),
            );
        }
    }
    let noisy = !matches!(sources[..], [] | ["fixed" | "level_threshold" | "screen_door"]);
    let hashes = matches!(sources[..], ["hashed" | "robust"]);
    if let Some(robust) = &effects.robust
        && matches!(robust.variant, Variant::Linear | Variant::Single)
    {
        return Err("`robust.variant` must be isotropic or anisotropic".to_owned());
    }
    if effects.foveated.is_some() && effects.finest_level.is_some() {
        return Err("`foveated` reads coarser levels and `finest_level` none; keep one".to_owned());
    }
    if effects.finest_level.is_some() && effects.limited_level.is_some() {
        return Err("`finest_level` and `limited_level` both choose the level; keep one".to_owned());
    }
    if let Some(independent) = &effects.independent
        && independent.by == Apart::Word
    {
        let hash = effects.hashed.as_ref().map(|h| h.hash).or(effects.robust.as_ref().map(|r| r.hash));
        if hash.is_some_and(|hash| !hash.reads_octave()) {
            let known = HashKind::ALL.into_iter().filter(|hash| hash.reads_octave());
            let [others @ .., last] = &known.map(HashKind::name).collect::<Vec<_>>()[..] else {
                unreachable!()
            };
            return Err(format!(
                "`independent.by` = \"word\" needs a hash that reads the word: {} or {last}",
                others.join(", ")
            ));
        }
    }
    for (what, present, met, need) in [
        ("coordinates", effects.coordinates.is_some(), hashes, "`hashed` or `robust`"),
        ("independent", effects.independent.is_some(), hashes, "`hashed` or `robust`"),
        ("temporal", effects.temporal.is_some(), noisy, "`hashed`, `robust` or `stochastic`"),
        ("fade_in", effects.fade_in.is_some(), noisy, "`hashed`, `robust` or `stochastic`"),
    ] {
        if present && !met {
            return Err(format!("`{what}` needs {need}: there is no noise for it to work on"));
        }
    }
    if let Some(multisampling) = &effects.multisampling {
        if effects.alpha_to_coverage.as_ref().is_some_and(|c| c.samples != multisampling.samples) {
            return Err("`multisampling` and `alpha_to_coverage` must have the same samples".to_owned());
        }
        if effects.conservative.is_some() || effects.occlusion.is_some() {
            return Err(
                "`multisampling` knows places in a pixel, `conservative` and `occlusion` pixels; keep one"
                    .to_owned(),
            );
        }
        if effects.test_then_blend.is_some() {
            return Err(
                "`test_then_blend` blends whole pixels, not samples; take `multisampling` out".to_owned()
            );
        }
    }
    if let Some(coverage) = &effects.alpha_to_coverage {
        match coverage.pattern {
            Pattern::Regular | Pattern::Hardware | Pattern::Pixel if !sources.is_empty() => {
                let pattern = coverage.pattern.name();
                return Err(format!("the {pattern} pattern needs no threshold; take `{}` out", sources[0]));
            }
            Pattern::Jittered | Pattern::Decorrelated | Pattern::Random if !noisy => {
                return Err("that pattern needs `hashed`, `robust` or `stochastic`".to_owned());
            }
            Pattern::Independent if effects.stochastic.is_none() => {
                return Err("the independent pattern needs `stochastic`".to_owned());
            }
            _ => {}
        }
    }
    if effects.conservative.is_some() && effects.test_then_blend.is_some() {
        return Err(
            "`conservative` corrects thresholds and `test_then_blend` blends without; keep one".to_owned()
        );
    }
    let is_fixed = matches!(sources[..], [] | ["fixed"]) && effects.alpha_to_coverage.is_none();
    for (what, present) in
        [("test_then_blend", effects.test_then_blend.is_some()), ("stipple", effects.stipple.is_some())]
    {
        if present && !is_fixed {
            return Err(format!("`{what}` works with one threshold: take the other away or use `fixed`"));
        }
    }
    if effects.test_then_blend.is_some() && effects.stipple.is_some() {
        return Err("`test_then_blend` would fill the holes of `stipple`; keep one".to_owned());
    }
    if let Some(occlusion) = &effects.occlusion {
        if matches!(occlusion.variant, Variant::Linear | Variant::Single) {
            return Err("`occlusion.variant` must be isotropic or anisotropic".to_owned());
        }
        if effects.test_then_blend.is_some() {
            return Err(
                "`occlusion` needs one surface a pixel and `test_then_blend` shows several; keep one"
                    .to_owned(),
            );
        }
    }
    if effects.scaled_alpha.is_some() && effects.scaled_texels.is_some() {
        return Err("`scaled_alpha` and `scaled_texels` both scale alphas; keep one".to_owned());
    }
    Ok(())
}
