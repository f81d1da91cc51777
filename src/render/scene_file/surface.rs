//! Surfaces of a scene file, and the triangles that they become.

use super::procedural::Checkerboard;
use crate::render::draw::mesh::{Mesh, Object, Vertex};
use crate::render::draw::texture::{Filter, TextureSource, Wrap};
use glam::{DAffine3, DMat3, DQuat, DVec2, DVec3, DVec4, EulerRot, dvec2, dvec3};
use rand::rngs::Xoshiro256PlusPlus;
use rand::{RngExt, SeedableRng};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// A surface: what covers it, where it stands, and exactly one table that says what it is.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Surface {
    /// Name of the texture that covers it; a mesh may bring its own, a checkerboard does.
    pub texture: Option<String>,
    /// Its place in the world, in object units.
    #[serde(default)]
    pub position: [f64; 3],
    /// Turns about x, y and z in the world, in degrees.
    #[serde(default)]
    pub turn: [f64; 3],
    /// The same within the coordinates of its object, which are hashed: models seldom follow their axes exactly.
    #[serde(default)]
    pub model_turn: [f64; 3],
    /// Change of its place, in object units per frame.
    #[serde(default)]
    pub drift: [f64; 3],
    /// Turn about its own y axis, in degrees per frame.
    #[serde(default)]
    pub spin: f64,
    /// Sideways sway of the points at height one (object units) and its length in frames.
    #[serde(default)]
    pub sway: [f64; 2],
    /// A rectangle in the plane of constant z, middle at the origin.
    pub card: Option<Card>,
    /// A rectangle in the plane of constant y.
    pub plane: Option<Card>,
    /// A row of panels in the plane of constant z.
    pub fence: Option<Fence>,
    /// A crown of many cards.
    pub foliage: Option<Foliage>,
    /// Copies of one card, spread over the ground.
    pub instances: Option<Instances>,
    /// Strips that hang from a cap.
    pub hair: Option<HairStrips>,
    /// Parallel cards, one behind the other.
    pub stack: Option<Stack>,
    /// Transparent and opaque squares in the plane of constant y, with a texture of its own.
    pub checkerboard: Option<Board>,
    /// A glTF file.
    pub mesh: Option<MeshFile>,
}

/// A rectangle.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Card {
    /// Width and height, in object units.
    pub size: [f64; 2],
    /// How often the texture repeats along each side.
    #[serde(default = "once")]
    pub repeat: [f64; 2],
}

/// Panels side by side.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fence {
    /// Number of panels.
    pub panels: u32,
    /// Width and height of one, in object units.
    pub size: [f64; 2],
    /// How often the texture repeats along each side of a panel.
    #[serde(default = "once")]
    pub repeat: [f64; 2],
}

/// Cards at random places of an ellipsoid.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Foliage {
    /// Number of cards.
    pub cards: u32,
    /// Side of a card, in object units.
    pub card: f64,
    /// Half axes of the crown, in object units.
    pub radii: [f64; 3],
}

/// Copies of one upright card.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Instances {
    /// Number of copies.
    pub count: u32,
    /// Width and height of the card, in object units.
    pub size: [f64; 2],
    /// Half the sides of the ground that they cover, in object units.
    pub ground: [f64; 2],
}

/// Strips of hair.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HairStrips {
    /// Number of strips.
    pub strips: u32,
    /// Width and length of one, in object units.
    pub size: [f64; 2],
    /// Radius of the cap that they hang from, in object units.
    pub radius: f64,
}

/// Parallel cards.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stack {
    /// Number of cards.
    pub cards: u32,
    /// Width and height of one, in object units.
    pub size: [f64; 2],
    /// From one card to the next, in object units.
    pub distance: f64,
}

/// A checkerboard: squares of alpha 0 and 1 in turn.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Board {
    /// Length of both sides, in object units.
    pub size: [f64; 2],
    /// Side of a square, in object units.
    pub square: f64,
}

impl Board {
    /// Squares along each side of its texture.
    const SQUARES: u32 = 8;

    /// Returns its texture, read along the longer axis of a footprint: boards are seen at grazing angles.
    #[must_use]
    pub fn texture() -> TextureSource {
        let finest = Checkerboard { squares: Self::SQUARES }.draw(256, 1.0);
        TextureSource::new(finest, Wrap::Repeat, Filter::Anisotropic)
    }
}

/// A mesh from a file.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    /// The glTF file (`.gltf` or `.glb`), relative to the scene file.
    pub file: PathBuf,
    /// What its units are multiplied by.
    #[serde(default = "unit")]
    pub scale: f64,
    /// How alpha is taken, whatever its materials say.
    pub alpha_mode: Option<AlphaMode>,
    /// Names of textures of the scene by the names of the materials that they stand in for.
    #[serde(default)]
    pub textures: BTreeMap<String, String>,
}

/// How the alpha of a material is taken, in the words of glTF.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AlphaMode {
    /// Not at all: everything is opaque.
    Opaque,
    /// What is below the cutoff of the material is clear, the rest is opaque.
    Mask,
    /// As coverage.
    Blend,
}

fn once() -> [f64; 2] {
    [1.0, 1.0]
}

fn unit() -> f64 {
    1.0
}

impl Surface {
    /// The tables that say what it is, and whether each is present; a sound surface has one.
    pub(super) fn kinds(&self) -> [(&'static str, bool); 9] {
        [
            ("card", self.card.is_some()),
            ("plane", self.plane.is_some()),
            ("fence", self.fence.is_some()),
            ("foliage", self.foliage.is_some()),
            ("instances", self.instances.is_some()),
            ("hair", self.hair.is_some()),
            ("stack", self.stack.is_some()),
            ("checkerboard", self.checkerboard.is_some()),
            ("mesh", self.mesh.is_some()),
        ]
    }

    /// Returns the number of triangles that it becomes, but for those that come from a file.
    #[must_use]
    pub fn triangles(&self) -> u64 {
        let one = u32::from(self.card.is_some() || self.plane.is_some() || self.checkerboard.is_some());
        let parts = [
            self.fence.as_ref().map(|fence| fence.panels),
            self.foliage.as_ref().map(|foliage| foliage.cards),
            self.instances.as_ref().map(|instances| instances.count),
            self.hair.as_ref().map(|hair| hair.strips),
            self.stack.as_ref().map(|stack| stack.cards),
        ];
        2 * parts.into_iter().flatten().chain([one]).map(u64::from).sum::<u64>()
    }

    /// Returns how it stands in the world and moves.
    #[must_use]
    pub fn object(&self) -> Object {
        Object {
            to_world: DAffine3::from_rotation_translation(turned(self.turn), self.position.into()),
            drift: self.drift.into(),
            spin: self.spin.to_radians(),
            sway: self.sway,
        }
    }

    /// Adds its triangles to a mesh, but for those that come from a file.
    pub fn build(&self, mesh: &mut Mesh, object: u32, texture: u32, seed: u64) {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed ^ (u64::from(object) << 32) ^ 0x5eed);
        let model = DAffine3::from_quat(turned(self.model_turn));
        let flat = DAffine3::from_rotation_x(-core::f64::consts::FRAC_PI_2);
        let mut add = |size: [f64; 2], repeat: [f64; 2], place: DAffine3| {
            mesh.quad(rectangle(size, repeat, model * place), object, texture);
        };
        if let Some(Card { size, repeat }) = &self.card {
            add(*size, *repeat, DAffine3::IDENTITY);
        }
        if let Some(Card { size, repeat }) = &self.plane {
            add(*size, *repeat, flat);
        }
        if let Some(Board { size, square }) = &self.checkerboard {
            let repeat = size.map(|side| side / (square * f64::from(Board::SQUARES)));
            add(*size, repeat, flat);
        }
        if let Some(Fence { panels, size, repeat }) = &self.fence {
            for panel in 0..*panels {
                let middle = f64::from(panel) - 0.5 * f64::from(panels - 1);
                add(*size, *repeat, DAffine3::from_translation(DVec3::X * (middle * size[0])));
            }
        }
        if let Some(Foliage { cards, card, radii }) = &self.foliage {
            for _ in 0..*cards {
                let place = in_ball(&mut rng) * DVec3::from(*radii);
                let turn = frame(on_sphere(&mut rng));
                add([*card; 2], once(), DAffine3::from_mat3_translation(turn, place));
            }
        }
        if let Some(Instances { count, size, ground }) = &self.instances {
            for _ in 0..*count {
                let [x, z] = ground.map(|half| half * (2.0 * rng.random::<f64>() - 1.0));
                let turn = DQuat::from_rotation_y(core::f64::consts::TAU * rng.random::<f64>());
                let place = dvec3(x, 0.5 * size[1], z);
                add(*size, once(), DAffine3::from_rotation_translation(turn, place));
            }
        }
        if let Some(HairStrips { strips, size, radius }) = &self.hair {
            for _ in 0..*strips {
                let out = on_sphere(&mut rng);
                let out = dvec3(out.x, out.y.abs() * 0.6, out.z).normalize();
                let side = out.cross(DVec3::Y).normalize_or(DVec3::X);
                let turn = DMat3::from_cols(side, DVec3::Y, side.cross(DVec3::Y));
                let place = out * *radius - DVec3::Y * (0.5 * size[1]);
                add(*size, once(), DAffine3::from_mat3_translation(turn, place));
            }
        }
        if let Some(Stack { cards, size, distance }) = &self.stack {
            for card in 0..*cards {
                let place = DVec3::NEG_Z * (distance * f64::from(card));
                add(*size, once(), DAffine3::from_translation(place));
            }
        }
    }
}

/// Turns about x, y and z, in degrees.
fn turned(degrees: [f64; 3]) -> DQuat {
    let [x, y, z] = degrees.map(f64::to_radians);
    DQuat::from_euler(EulerRot::YXZ, y, x, z)
}

/// A rectangle in its own plane of constant z, put in its place in the object.
fn rectangle([width, height]: [f64; 2], repeat: [f64; 2], place: DAffine3) -> [Vertex; 4] {
    [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]].map(|[u, v]: [f64; 2]| {
        let part = dvec3((u - 0.5) * width, (0.5 - v) * height, 0.0);
        let texcoord = dvec2(u, v) * DVec2::from(repeat);
        Vertex { object: place.transform_point3(part), part, texcoord, tint: DVec4::ONE }
    })
}

fn on_sphere(rng: &mut Xoshiro256PlusPlus) -> DVec3 {
    let y = 2.0 * rng.random::<f64>() - 1.0;
    let turn = core::f64::consts::TAU * rng.random::<f64>();
    let around = (1.0 - y * y).sqrt();
    dvec3(around * libm::cos(turn), y, around * libm::sin(turn))
}

fn in_ball(rng: &mut Xoshiro256PlusPlus) -> DVec3 {
    on_sphere(rng) * libm::cbrt(rng.random::<f64>())
}

/// Axes of which the third is `normal`.
fn frame(normal: DVec3) -> DMat3 {
    let side = normal.cross(DVec3::Y).normalize_or(DVec3::X);
    DMat3::from_cols(side, normal.cross(side), normal)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_card_stands_upright_with_its_texture() {
        let [lower_left, _, upper_right, _] = rectangle([2.0, 4.0], [1.0, 3.0], DAffine3::IDENTITY);
        assert_eq!((lower_left.part, lower_left.texcoord), (dvec3(-1.0, -2.0, 0.0), dvec2(0.0, 3.0)));
        assert_eq!((upper_right.part, upper_right.texcoord), (dvec3(1.0, 2.0, 0.0), dvec2(1.0, 0.0)));
    }

    #[test]
    fn axes_are_orthonormal() {
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(1);
        for normal in (0..100).map(|_| on_sphere(&mut rng)).chain([DVec3::Y, DVec3::NEG_Y]) {
            let axes = frame(normal);
            assert!((axes * axes.transpose() - DMat3::IDENTITY).abs_diff_eq(DMat3::ZERO, 1e-12), "{axes}");
        }
    }
}
