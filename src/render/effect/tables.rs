//! The tables of effects as a scene file has them, one struct each.

use crate::render::draw::fragments::Space;
use crate::technique::foveated::Gaze;
use crate::threshold::cdf::CdfForm;
use crate::threshold::hash::HashKind;
use crate::threshold::robust::Join;
use crate::threshold::stage::order::Order;
use crate::threshold::stage::stipple::Density;
use crate::threshold::two_scale::Variant;
use core::num::NonZeroU32;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

/// Tests at several places of each pixel.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Supersampling {
    /// Places along each side of a pixel.
    pub samples: NonZeroU32,
}

/// Colours multiplied by alpha.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Premultiplied {}

/// Alpha from the finest level.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FinestLevel {}

/// Alpha from no coarser level.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LimitedLevel {
    /// The coarsest level that is read.
    pub level: f32,
}

/// A threshold a level.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LevelThreshold {}

/// Alphas scaled by level.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScaledAlpha {}

/// Alphas scaled by texel.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScaledTexels {
    /// How far around a texel the share is taken, in texels of its level.
    #[serde(default)]
    pub radius: usize,
}

/// A hash of its own for each frame.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Independent {
    /// Number of frames that belong together.
    pub frames: NonZeroU32,
    /// How their hashes are kept apart.
    #[serde(default)]
    pub by: Apart,
}

/// How the hashes of frames are kept apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Apart {
    /// Cells are shifted (§7.2.2).
    #[default]
    Offset,
    /// The octave word, for hashes that read it; not in the paper.
    Word,
}

/// A camera that moves within a pixel.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Jitter {
    /// Number of frames that belong together.
    pub frames: NonZeroU32,
}

/// Blending without a test.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NaiveBlend {}

/// The alpha test, and then what it left out, blended.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TestThenBlend {}

/// An exponential average of frames.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct History {
    /// Weight of the newest frame, in (0, 1].
    pub weight: f32,
    /// Whether the average is brought into the range of the newest frame around each pixel.
    #[serde(default)]
    pub clamp: bool,
    /// Whether the average is looked up where the motion of the camera has left it; without, pixels stay where they are.
    #[serde(default)]
    pub reproject: bool,
}

/// One threshold for all.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fixed {
    /// That threshold, in (0, 1].
    #[serde(default = "half")]
    pub threshold: f32,
}

/// A fresh threshold every time.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stochastic {}

/// A listing to the letter, or one of its ablations.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hashed {
    /// How scales are chosen from derivatives.
    #[serde(default = "isotropic", deserialize_with = "by_name")]
    pub variant: Variant,
    /// The hash of a cell.
    #[serde(default = "sine", deserialize_with = "by_name")]
    pub hash: HashKind,
    /// Size of the noise, in pixels.
    #[serde(default = "one")]
    pub hash_scale: f64,
    /// Eq. 2 to the letter, or without a division by zero.
    #[serde(default = "literal", deserialize_with = "by_name")]
    pub form: CdfForm,
}

/// The threshold with every repair.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobustHash {
    /// How scales are chosen from derivatives.
    #[serde(default = "isotropic", deserialize_with = "by_name")]
    pub variant: Variant,
    /// The hash of a cell.
    #[serde(default = "murmur", deserialize_with = "by_name")]
    pub hash: HashKind,
    /// Size of the noise, in pixels.
    #[serde(default = "one")]
    pub hash_scale: f64,
    /// How the hashes of two octaves become one value; by default the copula with one scale an axis and the paper's
    /// interpolation with one for all.
    #[serde(default, deserialize_with = "by_name_if_any")]
    pub join: Option<Join>,
}

/// What is hashed.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coordinates {
    /// The coordinates.
    pub space: Space,
}

/// Strata of frames.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Temporal {
    /// Number of frames that belong together.
    pub frames: NonZeroU32,
    /// Their order.
    #[serde(default = "alternating", deserialize_with = "order")]
    pub order: Order,
}

/// Several places of a pixel, at which geometry is tested.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Multisampling {
    /// Number of places, at most 64; those of `alpha_to_coverage` if that is there.
    pub samples: NonZeroU32,
}

/// Several tests in a pixel.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AlphaToCoverage {
    /// Number of samples in a pixel, at most 64.
    pub samples: NonZeroU32,
    /// Which thresholds they have.
    pub pattern: Pattern,
}

/// The thresholds of the samples of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Pattern {
    /// The fixed dither of Eq. 7; needs no hash.
    Regular,
    /// One jitter for all strata, Eq. 8.
    Jittered,
    /// The same with strata in an order that each layer has for itself, Eq. 9.
    Decorrelated,
    /// Independent draws, as stochastic transparency has them (§10).
    Independent,
    /// `floor(n alpha)` samples, always the same ones, as the paper has it of hardware (§3, §8); needs no hash.
    Hardware,
    /// One jitter for all strata, which are shuffled for each fragment: random sets of samples (§3, Enderton et al. 2010).
    Random,
    /// Strata turned by one value of the pixel, the same for all layers (Humus 2009); needs no threshold.
    Pixel,
}

impl Pattern {
    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Regular => "regular",
            Self::Jittered => "jittered",
            Self::Decorrelated => "decorrelated",
            Self::Independent => "independent",
            Self::Hardware => "hardware",
            Self::Random => "random",
            Self::Pixel => "pixel",
        }
    }
}

/// A mask over tiles of pixels.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScreenDoor {
    /// Which one.
    pub mask: Door,
}

/// The masks of a screen door of 4 x 4 pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Door {
    /// The ordered dither (§3).
    Fixed,
    /// One random order for all tiles and layers (§3, Mulder et al. 1998).
    Random,
    /// Strata permuted and jittered for each tile and layer (§8.1).
    Hashed,
}

impl Door {
    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Random => "random",
            Self::Hashed => "hashed",
        }
    }
}

/// Holes of one pixel, or of three.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stipple {
    /// How much of a surface is kept.
    #[serde(with = "DensityByName")]
    pub density: Density,
}

/// The names by which a user asks for a density.
#[derive(Deserialize)]
#[serde(remote = "Density", rename_all = "kebab-case")]
enum DensityByName {
    High,
    Low,
}

/// Noise that fades in.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FadeIn {
    /// Level of detail from which on all is noise, above 0.
    #[serde(default = "six")]
    pub full_noise_lod: f32,
    /// Whether the level is multiplied by the anisotropy of the texture access (§7.1.1).
    #[serde(default)]
    pub anisotropy: bool,
    /// The threshold without noise, in (0, 1]: one half in Eq. 4, or what an artist set.
    #[serde(default = "half")]
    pub authored: f32,
}

/// The mean of frames.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Average {
    /// Number of frames that are averaged.
    pub frames: NonZeroU32,
}

/// Every pixel that a surface touches.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Conservative {
    /// Whether thresholds are divided by the share of the pixel that the surface covers; without, surfaces grow by half a
    /// pixel on every side.
    #[serde(default = "yes")]
    pub corrected: bool,
}

/// Coarser levels away from where the viewer looks.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Foveated {
    /// The point looked at, in pixels from the upper left corner of the image.
    pub gaze: [f64; 2],
    /// Up to this distance everything is drawn in full, in pixels, at least 0.
    pub radius: f64,
    /// Growth of the size of a shaded sample beyond the radius, in pixels a pixel, at least 0.
    pub slope: f64,
}

impl Foveated {
    /// Returns where the viewer looks, in pixels of the image.
    #[must_use]
    pub const fn gaze(&self) -> Gaze {
        Gaze { centre: self.gaze, radius: self.radius, slope: self.slope }
    }
}

/// One ray a pixel into the open.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Occlusion {
    /// How far something may be in the way, in object units, above 0.
    pub reach: f64,
    /// Where the two numbers of a ray come from.
    #[serde(default)]
    pub chi: Chi,
    /// How the scales of what is hashed are chosen from derivatives: isotropic or anisotropic.
    #[serde(default = "isotropic", deserialize_with = "by_name")]
    pub variant: Variant,
}

/// The two numbers of a ray (§9).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Chi {
    /// Two hashes of one cell, by the listing.
    #[default]
    TwoHashes,
    /// One hash of two cells far apart, by the listing.
    Offsets,
    /// The robust threshold, twice by a word of its hash; not in the paper.
    Word,
    /// An ordinary generator, seeded by the coarse cell of the listing.
    Seeded,
    /// Fresh random numbers in every pixel and frame: what hashing is compared with.
    Random,
}

impl Chi {
    /// Every way to choose, the paper's first.
    pub const ALL: [Self; 5] = [Self::TwoHashes, Self::Offsets, Self::Word, Self::Seeded, Self::Random];

    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::TwoHashes => "two-hashes",
            Self::Offsets => "offsets",
            Self::Word => "word",
            Self::Seeded => "seeded",
            Self::Random => "random",
        }
    }
}

fn yes() -> bool {
    true
}

fn alternating() -> Order {
    Order::Alternating
}

fn order<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Order, D::Error> {
    const NAMES: [&str; 7] = [
        Order::ALL[0].name(),
        Order::ALL[1].name(),
        Order::ALL[2].name(),
        Order::ALL[3].name(),
        Order::ALL[4].name(),
        Order::ALL[5].name(),
        Order::ALL[6].name(),
    ];
    let name = String::deserialize(deserializer)?;
    let found = Order::ALL.into_iter().find(|order| order.name() == name);
    found.ok_or_else(|| D::Error::unknown_variant(&name, &NAMES))
}

fn half() -> f32 {
    0.5
}

fn one() -> f64 {
    1.0
}

fn six() -> f32 {
    6.0
}

fn isotropic() -> Variant {
    Variant::Isotropic
}

fn sine() -> HashKind {
    HashKind::Sine
}

fn murmur() -> HashKind {
    HashKind::Mm4
}

fn literal() -> CdfForm {
    CdfForm::Literal
}

fn by_name<'de, D, T>(deserializer: D) -> Result<T, D::Error>
where
    D: Deserializer<'de>,
    T: core::str::FromStr<Err: core::fmt::Display>,
{
    String::deserialize(deserializer)?.parse().map_err(D::Error::custom)
}

fn by_name_if_any<'de, D, T>(deserializer: D) -> Result<Option<T>, D::Error>
where
    D: Deserializer<'de>,
    T: core::str::FromStr<Err: core::fmt::Display>,
{
    by_name(deserializer).map(Some)
}
