//! What one frame becomes, and one tile of it.

use super::cost::Cost;
use super::fragments::Fragments;
use super::mesh::Mesh;
use super::rasterise::{Screen, TILE};
use super::rays::Occluders;
use super::setup::Setup;
use super::texture::{Access, Texture};
use crate::render::measure::depth::Depth;
use crate::render::measure::layers::LayerSums;
use crate::render::measure::picture::Picture;
use crate::scene::Camera;
use rand::SeedableRng;
use rand::rngs::Xoshiro256PlusPlus;

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

/// Pixels of a tile.
pub(in crate::render) const PIXELS: usize = (TILE * TILE) as usize;
/// No fragment.
pub(in crate::render) const NONE: u32 = u32::MAX;

/// What one tile becomes, row by row.
pub(in crate::render) struct TileResult {
    pub(in crate::render) colour: Vec<[f32; 3]>,
    pub(in crate::render) coverage: Vec<f32>,
    pub(in crate::render) touched: Vec<bool>,
    pub(in crate::render) cost: Cost,
    pub(in crate::render) layers: LayerSums,
    /// As those of [`Frame`].
    pub(in crate::render) rays: Vec<[u16; 2]>,
    /// Of no length unless asked for.
    pub(in crate::render) depth: Vec<f32>,
}

/// Scratch columns, reused from tile to tile.
pub(in crate::render) struct Work {
    pub(in crate::render) fragments: Fragments,
    pub(in crate::render) access: Vec<Access>,
    /// Texels that were read for alpha.
    pub(in crate::render) texels: u64,
    /// Alphas of the texture.
    pub(in crate::render) alpha: Vec<f32>,
    /// The alphas that are tested: those of the texture, unless an effect changes them.
    pub(in crate::render) tested: Vec<f32>,
    /// Thresholds that do not come from the pipeline's own sources; empty unless it asks for them.
    pub(in crate::render) given: Vec<f32>,
    /// One threshold a fragment, or one a sample.
    pub(in crate::render) threshold: Vec<f32>,
    /// The samples of each fragment that are kept, a bit each.
    pub(in crate::render) kept: Vec<u64>,
    /// The random numbers of the tile.
    pub(in crate::render) rng: Xoshiro256PlusPlus,
}

impl Default for Work {
    fn default() -> Self {
        Self {
            fragments: Fragments::default(),
            access: Vec::new(),
            texels: 0,
            alpha: Vec::new(),
            tested: Vec::new(),
            given: Vec::new(),
            threshold: Vec::new(),
            kept: Vec::new(),
            rng: Xoshiro256PlusPlus::seed_from_u64(0),
        }
    }
}

/// One tile of a frame, and what all tiles share.
pub(in crate::render) struct Shading<'a> {
    pub(in crate::render) mesh: &'a Mesh,
    /// The part that each triangle belongs to, see [`Mesh::parts`]; empty unless coverage is needed.
    pub(in crate::render) parts: &'a [u32],
    pub(in crate::render) textures: &'a [Texture],
    pub(in crate::render) setup: &'a Setup,
    pub(in crate::render) screen: &'a Screen,
    pub(in crate::render) camera: &'a Camera,
    /// Index of the frame.
    pub(in crate::render) frame: u32,
    /// What rays may hit, if there are any.
    pub(in crate::render) occluders: Option<&'a Occluders>,
    /// Index of the tile.
    pub(in crate::render) tile: usize,
}

impl Shading<'_> {
    /// The texture of a triangle.
    pub(in crate::render) fn texture(&self, triangle: u32) -> &Texture {
        &self.textures[self.mesh.triangles[triangle as usize].texture as usize]
    }

    /// The pixel of a fragment: its column and row.
    pub(in crate::render) fn place(&self, fragments: &Fragments, at: usize) -> [u32; 2] {
        let ([left, top], _) = self.screen.tile(self.tile);
        let pixel = u32::from(fragments.pixel[at]);
        [left + pixel % TILE, top + pixel / TILE]
    }

    /// Makes the fragments of the tile and reads their alpha.
    pub(in crate::render) fn sample(&self, work: &mut Work) {
        self.screen.fragments(self.tile, &mut work.fragments);
        let (corner, _) = self.screen.tile(self.tile);
        work.access.clear();
        work.alpha.clear();
        work.tested.clear();
        work.texels = 0;
        for at in 0..work.fragments.len() {
            let texture = self.texture(work.fragments.triangle[at]);
            let access = self.setup.access(texture, &work.fragments, corner, at);
            let [.., tint] = work.fragments.tint(at);
            let alpha = texture.alpha(&access, &mut work.texels) * tint;
            work.alpha.push(alpha);
            work.tested.push(self.setup.tested(alpha, texture));
            work.access.push(access);
        }
    }
}
