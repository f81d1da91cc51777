//! Scene files: TOML in, a checked [`SceneFile`] or an error with file, line, column and the likely remedy out.

use super::effects::{self, Effects};
use super::expect::Expectation;
use super::mistake::{nearest, place, plain, suggest};
use super::procedural::{Checkerboard, Constant, Hair, Leaves, Ramp, Wire};
use super::surface::Surface;
use super::texture::{Filter, Wrap};
use super::view::View;
use core::fmt;
use core::num::NonZeroU32;
use core::ops::Range;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::path::PathBuf;

/// The largest side of an image, in pixels.
pub const LARGEST_SIDE: u32 = 16_384;

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
    pub truth: Option<Truth>,
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
    pub name: toml::Spanned<String>,
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

/// An image file.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImageFile {
    /// The file, relative to the scene file.
    pub file: PathBuf,
    /// Where alpha is taken from; by default the alpha channel, which must be there then.
    #[serde(default)]
    pub alpha: Channel,
}

/// Where the alpha of an image file is taken from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Channel {
    /// Its alpha channel.
    #[default]
    Alpha,
    /// Its luminance.
    Luminance,
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

/// Ground truth.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Truth {
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

/// A depth buffer, and a smaller one that is made of it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DepthBuffer {
    /// How many pixels along each side become one of the smaller buffer.
    pub ratio: NonZeroU32,
}

/// A part of the picture whose coverage is a number of its own.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Region {
    /// What its numbers are called.
    pub name: String,
    /// Its upper left pixel.
    pub corner: [u32; 2],
    /// Its width and height in pixels.
    pub size: [u32; 2],
}

/// A part of the picture, enlarged.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Inset {
    /// Its upper left pixel.
    pub corner: [u32; 2],
    /// Its width and height in pixels.
    pub size: [u32; 2],
    /// How many times it is enlarged.
    pub times: NonZeroU32,
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

/// A scene file that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}:{line}:{column}: {message}")]
pub struct FileError {
    /// Name of the file.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What is wrong, and what would be right.
    pub message: String,
}

/// Reads a scene.
///
/// # Errors
///
/// [`FileError`] for text that is no TOML, a key that does not exist (with the one that was likely meant), a value out of
/// its range, a surface without a texture, or two tables where one is meant.
pub fn read(text: &str, file: &str) -> Result<SceneFile, FileError> {
    let at = |span: Option<Range<usize>>, message: String| {
        let (line, column) = place(text, span.map_or(0, |span| span.start));
        FileError { file: file.to_owned(), line, column, message }
    };
    let scene: SceneFile = toml::from_str(text).map_err(|error| {
        let message = error.message().trim().replace('\n', "; ");
        at(error.span(), suggest(&message).unwrap_or_else(|| plain(&message)))
    })?;
    check(&scene).map_err(|(span, message)| at(span, message))?;
    if let Takes::Sets(sets) = &scene.effects {
        for (index, set) in sets.iter().enumerate() {
            effects::check(set).map_err(|message| at(place_of_take(text, index), message))?;
        }
    }
    Ok(scene)
}

/// Where a take begins in the text of its file.
fn place_of_take(text: &str, index: usize) -> Option<Range<usize>> {
    #[derive(Deserialize)]
    struct Takes {
        effects: toml::Spanned<IgnoredAny>,
    }
    #[derive(Deserialize)]
    struct Sets {
        effects: Vec<toml::Spanned<IgnoredAny>>,
    }
    match toml::from_str::<Sets>(text) {
        Ok(Sets { effects }) => effects.get(index).map(toml::Spanned::span),
        Err(_) => toml::from_str::<Takes>(text).ok().map(|takes| takes.effects.span()),
    }
}

type Wrong = (Option<Range<usize>>, String);

/// What no single key is to blame for.
fn check(scene: &SceneFile) -> Result<(), Wrong> {
    let wrong = |message: String| Err((None, message));
    if !scene.resolution.iter().all(|side| (1..=LARGEST_SIDE).contains(side)) {
        return wrong(format!("`resolution` must be from 1 to {LARGEST_SIDE} pixels along each side"));
    }
    let [eye, target] = [scene.camera.eye, scene.camera.target];
    if eye == target || !eye.iter().chain(&target).all(|c| c.is_finite()) {
        return wrong("`camera.eye` and `camera.target` must be two finite points".to_owned());
    }
    let up = glam::DVec3::from(scene.camera.up).cross(glam::DVec3::from(eye) - glam::DVec3::from(target));
    if up.length() <= 1e-9 {
        return wrong("`camera.up` must not be along the line of sight".to_owned());
    }
    if !(scene.camera.half_height.is_finite() && scene.camera.half_height > 0.0) {
        return wrong("`camera.half_height` must be above 0".to_owned());
    }
    if scene
        .camera
        .motion
        .and_then(|motion| motion.zoom)
        .is_some_and(|zoom| !(zoom.is_finite() && zoom > 0.0))
    {
        return wrong("`camera.motion.zoom` must be above 0".to_owned());
    }
    for texture in &scene.texture {
        let name = &texture.name;
        let kinds = texture.kinds();
        exactly_one(Some(name.span()), &format!("texture `{}`", name.as_ref()), &kinds, TEXTURES)?;
        if !(1..=4096).contains(&texture.size) || !(0.0..=1.0).contains(&texture.opaque) {
            let message = "`size` must be from 1 to 4096 texels and `opaque` in [0, 1]".to_owned();
            return Err((Some(name.span()), message));
        }
    }
    let names: Vec<&str> = scene.texture.iter().map(|texture| texture.name.as_ref().as_str()).collect();
    for (index, surface) in scene.surface.iter().enumerate() {
        let what = format!("surface {}", index + 1);
        exactly_one(surface.texture.as_ref().map(toml::Spanned::span), &what, &surface.kinds(), SURFACES)?;
        match &surface.texture {
            Some(name) if !names.contains(&name.as_ref().as_str()) => {
                let likely = nearest(name.as_ref(), &names)
                    .map_or_else(String::new, |near| format!(" Did you mean `{near}`?"));
                return Err((
                    Some(name.span()),
                    format!("no texture is called `{}`.{likely}", name.as_ref()),
                ));
            }
            None if surface.mesh.is_none() => return wrong(format!("{what} has no `texture`")),
            _ => {}
        }
    }
    if let Some(distance) = &scene.distance
        && !distance.factors.iter().all(|factor| factor.is_finite() && *factor > 0.0)
    {
        return wrong("`distance.factors` must be above 0".to_owned());
    }
    Ok(())
}

const TEXTURES: &str = "leaves, wire, hair, checkerboard, constant, ramp, image";
const SURFACES: &str = "card, plane, fence, foliage, instances, hair, stack, mesh";

fn exactly_one(span: Option<Range<usize>>, what: &str, kinds: &[&str], known: &str) -> Result<(), Wrong> {
    match kinds {
        [_] => Ok(()),
        [] => Err((span, format!("{what} says not what it is; add one table of: {known}"))),
        _ => Err((span, format!("{what} is {} at once; keep one", kinds.join(" and ")))),
    }
}

impl TextureTable {
    /// The tables that are present, by name; a sound texture has one.
    fn kinds(&self) -> Vec<&'static str> {
        let all = [
            ("leaves", self.leaves.is_some()),
            ("wire", self.wire.is_some()),
            ("hair", self.hair.is_some()),
            ("checkerboard", self.checkerboard.is_some()),
            ("constant", self.constant.is_some()),
            ("ramp", self.ramp.is_some()),
            ("image", self.image.is_some()),
        ];
        all.into_iter().filter(|&(_, present)| present).map(|(name, _)| name).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOUND: &str = "\
name = \"card\"
[camera]
eye = [0.0, 0.0, 5.0]
target = [0.0, 0.0, 0.0]
[[texture]]
name = \"leaf\"
leaves = {}
[[surface]]
texture = \"leaf\"
card = { size = [1.0, 1.0] }
[effects.hashed]
variant = \"anisotropic\"
";

    fn wrong(from: &str, to: &str) -> String {
        assert!(SOUND.contains(from));
        read(&SOUND.replace(from, to), "s.toml").unwrap_err().to_string()
    }

    #[test]
    fn a_sound_scene_is_read() {
        let scene = read(SOUND, "s.toml").unwrap();
        let Takes::Sets(sets) = &scene.effects else { panic!() };
        assert!(sets[0].hashed.is_some() && sets[0].fixed.is_none());
        assert_eq!(
            read(&SOUND.replace("[effects.hashed]\nvariant = \"anisotropic\"", ""), "").unwrap().effects,
            Takes::default()
        );
        let auto = SOUND.replace("[effects.hashed]\nvariant = \"anisotropic\"", "");
        assert_eq!(read(&format!("effects = \"auto\"\n{auto}"), "").unwrap().effects, Takes::Auto);
    }

    #[test]
    fn mistakes_are_named_with_their_place_and_the_likely_word() {
        for (from, to, expected) in [
            ("variant", "varient", "s.toml:12:1: unknown key `varient`. Did you mean `variant`?"),
            (
                "[effects.hashed]",
                "[effects.hasht]",
                "s.toml:11:10: unknown key `hasht`. Did you mean `hashed`?",
            ),
            ("anisotropic", "anistropic", "s.toml:12:11: unknown"),
            (
                "texture = \"leaf\"",
                "texture = \"leav\"",
                "s.toml:9:11: no texture is called `leav`. Did you mean `leaf`?",
            ),
            ("leaves = {}", "", "s.toml:6:8: texture `leaf` says not what it is"),
            ("leaves = {}", "leaves = {}\nconstant = { alpha = 0.5 }", "is leaves and constant at once"),
            ("0.0, 0.0, 5.0", "0.0, 0.0", "s.toml:3:7: "),
            ("[camera]", "[camera", "s.toml:2:8: "),
            ("eye = [0.0, 0.0, 5.0]", "eye = [0.0, 0.0, 0.0]", "two finite points"),
            ("eye = [0.0, 0.0, 5.0]", "eye = [0.0, 5.0, 0.0]", "line of sight"),
            ("name = \"card\"", "name = \"card\"\nresolution = [0, 5]", "from 1 to 16384"),
            ("variant = \"anisotropic\"", "[effects.fixed]", "hashed"),
            ("card = { size = [1.0, 1.0] }", "sphere = 1", "unknown key `sphere`"),
        ] {
            let message = wrong(from, to);
            assert!(message.contains(expected), "{to}: {message}");
        }
    }
}
