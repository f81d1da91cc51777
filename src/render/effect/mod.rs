//! The effects that a scene can call for: one optional table each, one file each, and the scenes that show them.
//!
//! A new effect is a file here, which implements [`Effect`], a scene beside those of
//! [`gallery`](super::gallery), and their lines in the lists below.

pub mod alpha_to_coverage;
pub mod average;
pub mod conservative;
pub mod coordinates;
pub mod fade_in;
pub mod finest_level;
pub mod fixed;
pub mod foveated;
pub mod hashed;
pub mod history;
pub mod independent;
pub mod jitter;
pub mod kind;
pub mod level_bias;
pub mod level_threshold;
pub mod limited_level;
pub mod multisampling;
pub mod naive_blend;
pub mod occlusion;
pub mod plan;
pub mod premultiplied;
pub mod robust;
pub mod scaled_alpha;
pub mod scaled_texels;
pub mod screen_door;
pub mod sharpened;
pub mod stipple;
pub mod stochastic;
pub mod supersampling;
pub mod temporal;
pub mod test_then_blend;

use crate::render::draw::plan::Plan;
use crate::render::scene_file::diagnostic::Diagnostic;
use kind::{About, Effect, Rules, Technique};
use serde::Deserialize;

/// An effect of the list.
#[derive(Clone, Copy)]
pub struct Known {
    /// The name of its table.
    pub name: &'static str,
    /// What is known of it without looking at a scene.
    pub about: About,
    /// Takes it out of a set.
    pub remove: fn(&mut Effects),
    /// What it is to others in a set that has it.
    pub(in crate::render) rules: fn(&Effects) -> Option<Rules>,
    /// Adds its stages if a set has it.
    pub(in crate::render) plan: fn(&Effects, &mut Plan),
    /// Finds what is wrong with its values if a set has it.
    pub(in crate::render) check: fn(&Effects, &Plan) -> Result<(), Diagnostic>,
}

impl Known {
    /// Returns whether a set of effects has it.
    #[must_use]
    pub fn is_in(&self, effects: &Effects) -> bool {
        (self.rules)(effects).is_some()
    }
}

/// Declares the struct of tables and the list that tests, pages and `explain` walk.
macro_rules! effects {
    ($($field:ident: $table:ident,)*) => {
        /// The effects of one take of a scene; the order is that of the list of known effects.
        #[derive(Clone, Debug, Default, PartialEq, Deserialize)]
        #[serde(deny_unknown_fields)]
        pub struct Effects {
            /// What the take is called in pictures and tables.
            pub name: Option<String>,
            $(
                #[doc = concat!("See [`", stringify!($table), "`](", stringify!($field), "::", stringify!($table), ").")]
                pub $field: Option<$field::$table>,
            )*
        }

        /// Every effect, in the order in which they act.
        pub const ALL: &[Known] = &[$(
            Known {
                name: stringify!($field),
                about: $field::$table::ABOUT,
                remove: |effects| effects.$field = None,
                rules: |effects| effects.$field.as_ref().map(Effect::rules),
                plan: |effects, plan| effects.$field.iter().for_each(|table| table.plan(plan)),
                check: |effects, plan| effects.$field.as_ref().map_or(Ok(()), |table| table.check(plan)),
            },
        )*];
    };
}

effects! {
    supersampling: Supersampling,
    conservative: Conservative,
    premultiplied: Premultiplied,
    multisampling: Multisampling,
    foveated: Foveated,
    finest_level: FinestLevel,
    level_bias: LevelBias,
    limited_level: LimitedLevel,
    level_threshold: LevelThreshold,
    scaled_alpha: ScaledAlpha,
    scaled_texels: ScaledTexels,
    fixed: Fixed,
    stochastic: Stochastic,
    hashed: Hashed,
    robust: RobustHash,
    screen_door: ScreenDoor,
    stipple: Stipple,
    coordinates: Coordinates,
    independent: Independent,
    jitter: Jitter,
    temporal: Temporal,
    alpha_to_coverage: AlphaToCoverage,
    sharpened: Sharpened,
    fade_in: FadeIn,
    naive_blend: NaiveBlend,
    test_then_blend: TestThenBlend,
    occlusion: Occlusion,
    history: History,
    average: Average,
}

/// A built-in scene file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuiltIn {
    /// The name by which a user asks for it.
    pub name: &'static str,
    /// The TOML text.
    pub text: &'static str,
}

/// Lists files of the folder `gallery`.
macro_rules! gallery {
    ($($name:literal,)*) => {
        /// Every built-in scene file, in the order of the figures.
        pub const GALLERY: &[BuiltIn] =
            &[$(BuiltIn { name: $name, text: include_str!(concat!("../gallery/", $name, ".toml")) }),*];
    };
}

gallery! {
    "vanishing-foliage",
    "mips-and-wires",
    "sub-pixel-cards",
    "samples-converge",
    "grazing-fence",
    "axis-plane",
    "blending",
    "octaves",
    "castano",
    "hair",
    "fade-in",
    "subpixel-motion",
    "checkerboard",
    "multisample",
    "sharpened-coverage",
    "layers",
    "pixel-masks",
    "screen-door",
    "stipple",
    "stipple-buffers",
    "noise-scales",
    "temporal-orders",
    "temporal-ghosts",
    "temporal-noise",
    "foveated",
    "occlusion",
    "halo",
    "coordinates",
    "auto",
}

/// Returns every technique that the sources name and a table is the price of, with that effect.
pub fn techniques() -> impl Iterator<Item = (&'static Known, &'static Technique)> {
    ALL.iter().flat_map(|known| known.about.techniques.iter().map(move |technique| (known, technique)))
}
