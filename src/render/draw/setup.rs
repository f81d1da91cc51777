//! How a frame is set up before anything is shaded.

use super::fragments::{Fragments, Needs, Space};
use super::rasterise::TILE;
use super::texture::{Access, Texture, TextureNeeds};
use crate::technique::foveated::Gaze;
use crate::technique::jitter::camera_jitter;
use crate::threshold::fixed::FIXED_THRESHOLD;
use crate::threshold::pipeline::{Pipeline, Source};
use core::num::NonZeroU32;
use glam::{DVec2, Vec2};

/// What effects change before anything is shaded: which fragments there are, where they read their textures, and which
/// threshold they are compared with. The default is that of the plain alpha test.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Setup {
    /// Places along each side of a pixel at which fragments are made, at least 1.
    pub places: u32,
    /// Samples of a pixel, from 1 to 64: bits of what is kept of a fragment.
    pub samples: NonZeroU32,
    /// What must be known of a fragment.
    pub needs: Needs,
    /// The coordinates that are hashed.
    pub space: Space,
    /// What is needed of textures.
    pub textures: TextureNeeds,
    /// What is added to the level of detail that alpha is read at.
    pub level_bias: f32,
    /// The coarsest level that alpha is read from; any without.
    pub coarsest: Option<f32>,
    /// Where the viewer looks: further away coarser levels are read.
    pub gaze: Option<Gaze>,
    /// The number of frames in which the camera moves within a pixel.
    pub jitter: Option<NonZeroU32>,
    /// Whether rays are traced.
    pub rays: bool,
    /// Whether pictures are mixed with those of the frames before.
    pub mixes: bool,
    /// The thresholds of fragments and their samples; `None` where nothing is tested.
    pub pipeline: Option<Pipeline>,
    /// Whether the one threshold for all gives way to that of a material that has a test of its own.
    pub yields_to_material: bool,
}

impl Default for Setup {
    fn default() -> Self {
        Self {
            places: 1,
            samples: NonZeroU32::MIN,
            needs: Needs { texture_derivatives: true, ..Needs::default() },
            space: Space::Object,
            textures: TextureNeeds::default(),
            level_bias: 0.0,
            coarsest: None,
            gaze: None,
            jitter: None,
            rays: false,
            mixes: false,
            pipeline: Some(Pipeline::of(Source::Fixed(FIXED_THRESHOLD as f32))),
            yields_to_material: true,
        }
    }
}

impl Setup {
    /// Changes the thresholds, if anything is tested.
    pub fn thresholds(&mut self, change: impl FnOnce(&mut Pipeline)) {
        self.pipeline.as_mut().map(change);
    }

    /// Takes thresholds from another source.
    pub fn source(&mut self, source: Source) {
        self.thresholds(|pipeline| pipeline.source = source);
    }

    /// Returns the alpha that is tested for one that was read. Where the threshold of all gives way to that of a material, alpha is
    /// scaled, so that the one is met where the other would be.
    #[must_use]
    pub fn tested(&self, alpha: f32, texture: &Texture) -> f32 {
        let (Some(pipeline), Some(cutoff)) = (&self.pipeline, texture.cutoff) else { return alpha };
        let threshold = match pipeline.source {
            Source::Fixed(threshold) if pipeline.uses_source() => threshold,
            Source::Stipple { kept, .. } => kept,
            Source::Fixed(_)
            | Source::Given
            | Source::Stochastic
            | Source::Hash(_)
            | Source::ScreenDoor(_) => return alpha,
        };
        if !self.yields_to_material || cutoff == threshold {
            return alpha;
        }
        // Compared first: a scaled alpha may round to the wrong side.
        let scaled = alpha * (threshold / cutoff);
        if alpha >= cutoff { scaled.max(threshold) } else { scaled.min(threshold.next_down()) }
    }

    /// Returns how far the image is moved to the right and down in a frame, in pixels of the places.
    #[must_use]
    pub fn offset(&self, frame: u32) -> DVec2 {
        let jitter = self.jitter.map_or([0.0; 2], |frames| camera_jitter(frame, frames));
        DVec2::from(jitter) * f64::from(self.places)
    }

    /// Returns where a fragment of the tile whose upper left pixel is `corner` reads its texture.
    #[must_use]
    pub fn access(&self, texture: &Texture, fragments: &Fragments, corner: [u32; 2], at: usize) -> Access {
        let [dtdx, dtdy] = if self.needs.texture_derivatives {
            [fragments.dtdx[at], fragments.dtdy[at]]
        } else {
            [Vec2::ZERO; 2]
        };
        let mut access = texture.access(fragments.texcoord[at], dtdx, dtdy);
        access.lod += self.level_bias;
        if let Some(gaze) = &self.gaze {
            let pixel = u32::from(fragments.pixel[at]);
            let place = [corner[0] + pixel % TILE, corner[1] + pixel / TILE];
            let place = place.map(|along| (f64::from(along) + 0.5) / f64::from(self.places));
            access.lod += gaze.coarser_by(place) as f32;
        }
        if let Some(coarsest) = self.coarsest {
            access.lod = access.lod.min(coarsest);
        }
        access
    }
}
