//! What one frame becomes, and one tile of it.

use super::cost::Cost;
use super::fragments::Fragments;
use super::plan::Plan;
use super::rasterise::Screen;
use super::rasterise::TILE;
use super::rays::Occluders;
use super::texture::Access;
use super::texture::Texture;
use crate::render::measure::depth::Depth;
use crate::render::measure::layers::LayerSums;
use crate::render::measure::picture::Picture;
use crate::render::scene_file::load::Scene;
use crate::scene::Camera;

/// One frame as it was drawn.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    /// What is seen.
    pub picture: Picture,
    /// Whether a pixel has a fragment at all, row by row.
    pub touched: Vec<bool>,
    /// What was counted.
    pub cost: Cost,
    /// What the first two layers have in common; zeros unless asked for.
    pub layers: LayerSums,
    /// For each pixel the number of its rays and of those that are open; empty without occlusion.
    pub rays: Vec<[u16; 2]>,
    /// The depth buffer, at the first sample of each pixel and before anything is averaged; `None` unless asked for.
    pub depth: Option<Depth>,
}

pub(in crate::render) const PIXELS: usize = (TILE * TILE) as usize;
pub(in crate::render) const NONE: u32 = u32::MAX;

/// What one tile becomes.
pub(in crate::render) struct TileResult {
    pub(in crate::render) colour: Vec<[f32; 3]>,
    pub(in crate::render) coverage: Vec<f32>,
    pub(in crate::render) touched: Vec<bool>,
    pub(in crate::render) cost: Cost,
    pub(in crate::render) layers: LayerSums,
    pub(in crate::render) rays: Vec<[u16; 2]>,
    /// Of no length unless asked for.
    pub(in crate::render) depth: Vec<f32>,
}

/// Columns beside those of the fragments, kept from tile to tile for their room.
#[derive(Default)]
pub(in crate::render) struct Work {
    pub(in crate::render) fragments: Fragments,
    pub(in crate::render) access: Vec<Access>,
    pub(in crate::render) alpha: Vec<f32>,
    /// One threshold a fragment, or one a sample.
    pub(in crate::render) threshold: Vec<f32>,
    /// The samples of each fragment that are kept, a bit each.
    pub(in crate::render) kept: Vec<u64>,
}

/// What all tiles of a frame share.
pub(in crate::render) struct Draw<'a> {
    pub(in crate::render) scene: &'a Scene,
    pub(in crate::render) textures: &'a [Texture],
    pub(in crate::render) plan: &'a Plan,
    pub(in crate::render) screen: &'a Screen,
    pub(in crate::render) frame: u32,
    pub(in crate::render) camera: &'a Camera,
    /// What rays may hit, if there are any.
    pub(in crate::render) occluders: Option<Occluders>,
}
