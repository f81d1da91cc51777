//! What a scene file may have, as serde reads it.

use super::image::ImageFile;
use super::procedural::{Checkerboard, Constant, Hair, Leaves, Ramp, Wire};
use super::surface::Surface;
use crate::render::draw::texture::{Filter, Wrap};
use crate::render::draw::view::View;
use crate::render::effect::Effects;
use crate::render::measure::depth::DepthBuffer;
use crate::render::measure::picture::{Inset, Region};
use core::fmt;
use core::num::NonZeroU32;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

/// A scene as its file has it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    /// The name of what is written.
    pub name: String,
    /// The figure of the sources that it stands for.
    pub figure: Option<String>,
    /// What it must show, in one sentence.
    pub sentence: Option<String>,
    /// Width and height of the image in pixels.
    #[serde(default = "resolution")]
    pub resolution: [u32; 2],
    /// Number of frames.
    #[serde(default = "one")]
    pub frames: NonZeroU32,
    /// What every random choice begins with.
    #[serde(default)]
    pub seed: u64,
    /// Who looks.
    pub camera: View,
    /// What covers the surfaces.
    #[serde(default)]
    pub texture: Vec<TextureTable>,
    /// What is seen.
    pub surface: Vec<Surface>,
    /// What the picture is drawn into, as far as the effects may use it.
    #[serde(default)]
    pub target: Target,
    /// Sorted blending with supersampling beside it, and the error to it.
    pub truth: Option<ReferenceImage>,
    /// The same from further away.
    pub distance: Option<Distance>,
    /// Correlation of the first two layers.
    pub layers: Option<Layers>,
    /// The depth buffer, shown and measured.
    pub depth: Option<DepthBuffer>,
    /// Parts of the picture that are measured alone.
    #[serde(default)]
    pub region: Vec<Region>,
    /// What is enlarged in the picture.
    pub inset: Option<Inset>,
    /// The effects, one set a take; `"auto"` lets the planner choose.
    #[serde(default)]
    pub effects: Takes,
    /// What must come out.
    #[serde(default)]
    pub expect: Vec<Expectation>,
}

/// A texture: its name, how it is read, and exactly one table that says where it comes from.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TextureTable {
    /// The name by which surfaces ask for it.
    pub name: String,
    /// Texels along each side of a built-in map.
    #[serde(default = "texels")]
    pub size: u32,
    /// Alpha where a built-in map is opaque, in [0, 1].
    #[serde(default = "opaque")]
    pub opaque: f64,
    /// What lies beyond its edge.
    #[serde(default)]
    pub wrap: Wrap,
    /// How texels become one value.
    #[serde(default)]
    pub filter: Filter,
    /// A cluster of leaves.
    pub leaves: Option<Leaves>,
    /// Crossing wires.
    pub wire: Option<Wire>,
    /// Strands of hair.
    pub hair: Option<Hair>,
    /// A checkerboard.
    pub checkerboard: Option<Checkerboard>,
    /// The same alpha everywhere.
    pub constant: Option<Constant>,
    /// Alpha from 0 at the left edge to 1 at the right.
    pub ramp: Option<Ramp>,
    /// A PNG or JPEG file.
    pub image: Option<ImageFile>,
}

impl TextureTable {
    /// The tables that say where it comes from, and whether each is present; a sound texture has one.
    pub(super) fn kinds(&self) -> [(&'static str, bool); 7] {
        [
            ("leaves", self.leaves.is_some()),
            ("wire", self.wire.is_some()),
            ("hair", self.hair.is_some()),
            ("checkerboard", self.checkerboard.is_some()),
            ("constant", self.constant.is_some()),
            ("ramp", self.ramp.is_some()),
            ("image", self.image.is_some()),
        ]
    }
}

/// What the picture is drawn into.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Target {
    /// Samples a pixel.
    pub samples: NonZeroU32,
    /// Frames that temporal antialiasing averages.
    pub history: NonZeroU32,
}

impl Default for Target {
    fn default() -> Self {
        Self { samples: NonZeroU32::MIN, history: NonZeroU32::MIN }
    }
}

/// The reference image: sorted blending with supersampling.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReferenceImage {
    /// Samples along each side of a pixel.
    pub samples: NonZeroU32,
}

/// Distances.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Distance {
    /// Each as a multiple of the camera's.
    pub factors: Vec<f64>,
}

/// Correlation of layers.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Layers {}

/// A bound on a measured number of a take.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// The name of the take.
    pub take: String,
    /// The name of the number, see [`Metrics`](crate::render::measure::metrics::Metrics).
    pub metric: String,
    /// Another take: the bounds are multiples of its number.
    pub than: Option<String>,
    /// The least value that will do.
    pub at_least: Option<f64>,
    /// The greatest value that will do.
    pub at_most: Option<f64>,
}

/// The effects of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Takes {
    /// The planner chooses.
    Auto,
    /// One set of effects a take; never empty.
    Sets(Vec<Effects>),
}

impl Default for Takes {
    fn default() -> Self {
        Self::Sets(vec![Effects::default()])
    }
}

impl<'de> Deserialize<'de> for Takes {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Any;
        impl<'de> Visitor<'de> for Any {
            type Value = Takes;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("`\"auto\"`, a table of effects, or an array of such tables")
            }
            fn visit_str<E: serde::de::Error>(self, text: &str) -> Result<Takes, E> {
                if text == "auto" {
                    return Ok(Takes::Auto);
                }
                Err(E::unknown_variant(text, &["auto"]))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Takes, A::Error> {
                Ok(Takes::Sets(vec![Effects::deserialize(MapAccessDeserializer::new(map))?]))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, sequence: A) -> Result<Takes, A::Error> {
                let sets = Vec::deserialize(SeqAccessDeserializer::new(sequence))?;
                Ok(if sets.is_empty() { Takes::default() } else { Takes::Sets(sets) })
            }
        }
        deserializer.deserialize_any(Any)
    }
}

fn resolution() -> [u32; 2] {
    [320, 240]
}

fn one() -> NonZeroU32 {
    NonZeroU32::MIN
}

fn texels() -> u32 {
    256
}

fn opaque() -> f64 {
    1.0
}
