//! What a scene asks for, measured on the fragments of its first frame.

use crate::render::draw::fragments::{Fragments, Needs, Space};
use crate::render::draw::rasterise::{Screen, TILE};
use crate::render::draw::shot::Shot;
use crate::render::draw::texture::Texture;
use crate::render::draw::view::Cause;
use crate::render::scene_file::load::Scene;
use crate::threshold::fixed::passes;
use crate::threshold::stage::fade_in::anisotropy;
use glam::{DVec2, vec2};

/// Levels of detail that are told apart: 0 for magnified fragments, then one a level.
const LEVELS: usize = 14;

/// Numbers on a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Survey {
    /// Fragments of the first frame.
    pub fragments: u64,
    /// Pixels with a fragment, and with two or more.
    pub pixels: [u64; 2],
    /// Fragments whose footprint is more than twice as long as wide.
    pub oblique: u64,
    /// Fragments with an alpha strictly between 0.02 and 0.98.
    pub partial: u64,
    /// For each level of detail: fragments, those that the fixed test keeps, and the sum of alphas.
    pub levels: [[f64; 3]; LEVELS],
    /// Largest distance between the colour of opaque texels and what the filter makes of it at the coarsest level, among
    /// all textures, in [0, 1].
    pub bleeding: f64,
}

impl Survey {
    /// Surveys a scene from `distance` times as far as it says; `textures` hold colours as they are.
    #[must_use]
    pub fn new(scene: &Scene, textures: &[Texture], distance: f64) -> Self {
        let mut survey = Self::default();
        let shot = Shot { cause: Cause::All, distance };
        let needs = Needs { texture_derivatives: true, ..Needs::default() };
        let screen =
            Screen::new(&scene.mesh, &shot.camera(scene, 0, 1), 0.0, DVec2::ZERO, Space::Object, needs);
        let mut fragments = Fragments::default();
        for tile in 0..screen.tiles() {
            screen.fragments(tile, &mut fragments);
            survey.add(scene, textures, &fragments);
        }
        survey.bleeding = textures.iter().filter_map(bleeding).fold(0.0, f64::max);
        survey
    }

    fn add(&mut self, scene: &Scene, textures: &[Texture], fragments: &Fragments) {
        let mut layers = [0_u32; (TILE * TILE) as usize];
        for at in 0..fragments.len() {
            layers[usize::from(fragments.pixel[at])] += 1;
            let texture = &textures[scene.mesh.triangles[fragments.triangle[at] as usize].texture as usize];
            let (dtdx, dtdy) = (fragments.dtdx[at], fragments.dtdy[at]);
            let access = texture.access(fragments.texcoord[at], dtdx, dtdy);
            let alpha = texture.alpha(&access, &mut 0) * fragments.tint(at)[3];
            let [width, height] = texture.levels[0].size.map(|side| side as f32);
            let along = [dtdx, dtdy].map(|d| (d * vec2(width, height)).length());
            self.fragments += 1;
            self.oblique += u64::from(anisotropy(along) > 2.0);
            self.partial += u64::from(alpha > 0.02 && alpha < 0.98);
            let level = &mut self.levels[(access.lod.ceil().max(0.0) as usize).min(LEVELS - 1)];
            level[0] += 1.0;
            level[1] += f64::from(u8::from(passes(alpha, texture.reference())));
            level[2] += f64::from(alpha);
        }
        self.pixels[0] += layers.iter().filter(|&&layers| layers > 0).count() as u64;
        self.pixels[1] += layers.iter().filter(|&&layers| layers > 1).count() as u64;
    }

    /// Returns the share of all fragments that satisfy a count, in [0, 1].
    #[must_use]
    pub fn share(&self, count: u64) -> f64 {
        count as f64 / self.fragments.max(1) as f64
    }

    /// Returns the coverage that the fixed test gains or loses, level by level, as a share of all coverage.
    #[must_use]
    pub fn bias(&self) -> f64 {
        let wrong: f64 = self.levels.iter().map(|[_, kept, alpha]| (kept - alpha).abs()).sum();
        wrong / self.levels.iter().map(|level| level[2]).sum::<f64>().max(f64::MIN_POSITIVE)
    }

    /// Returns the first level of detail at which the fixed test is wrong by more than `tolerance` of its coverage; `None`
    /// where it never is.
    #[must_use]
    pub fn first_wrong_level(&self, tolerance: f64) -> Option<usize> {
        self.levels
            .iter()
            .position(|[count, kept, alpha]| *count > 0.0 && (kept - alpha).abs() > tolerance * alpha)
    }

    /// Returns the share of fragments that are magnified, in [0, 1].
    #[must_use]
    pub fn near(&self) -> f64 {
        self.levels[0][0] / (self.fragments.max(1) as f64)
    }
}

fn bleeding(texture: &Texture) -> Option<f64> {
    let finest = &texture.levels[0];
    let coarsest = texture.levels.last()?;
    let mut mean = [0.0; 3];
    let mut weight = 0.0;
    for (colour, &alpha) in finest.colour.iter().zip(&finest.alpha) {
        mean = [0, 1, 2].map(|c| mean[c] + f64::from(colour[c]) * f64::from(alpha));
        weight += f64::from(alpha);
    }
    let filtered = coarsest.colour.first()?;
    let apart =
        [0, 1, 2].map(|c| (mean[c] / f64::max(weight, 1e-9) - f64::from(filtered[c])).abs() / 65_535.0);
    Some(apart.into_iter().fold(0.0, f64::max))
}
