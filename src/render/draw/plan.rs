//! From the effects of a take to the ordered stages that simulate them, with what they need and what they cost.
//!
//! A plan is the program that a run carries out: what is not in its stages does not happen, and what no stage needs is
//! not computed.

use super::cost::Cost;
use super::fragments::{Fragments, Needs, Space};
use super::frame;
use super::rasterise::{Screen, TILE};
use super::rays;
use super::shot::{Shot, shots};
use super::texture::TextureNeeds;
use super::texture::{Scaling, Texture};
use crate::render::effect::stage::{Stage, hashes};
use crate::render::effect::tables::{Chi, Door, Pattern};
use crate::render::effect::{ALL, Effects, Known};
use crate::render::scene_file::load::Scene;
use crate::technique::foveated::Gaze;
use crate::technique::jitter::camera_jitter;
use crate::threshold::fixed::FIXED_THRESHOLD;
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::robust::Robust;
use core::num::NonZeroU32;
use glam::DVec2;
use rayon::prelude::*;

/// What of a frame costs depend on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Census {
    /// Fragments.
    pub fragments: u64,
    /// Texels that they read when all are read once.
    pub texels: u64,
    /// Pixels of the image.
    pub pixels: u64,
    /// Pixels of the places that show a surface; 0 where no stage asks.
    pub shown: u64,
}

/// What one take does.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The name of the take.
    pub name: String,
    /// The stages, in their order.
    pub stages: Vec<Stage>,
    /// What they need to know of a fragment.
    pub needs: Needs,
    /// The coordinates that are hashed.
    pub space: Space,
    /// Places along each side of a pixel at which fragments are made.
    pub places: u32,
    /// Samples of a pixel.
    pub samples: u32,
    /// What it needs of textures.
    pub textures: TextureNeeds,
    /// Where the viewer looks, if that matters.
    pub gaze: Option<Gaze>,
    /// The number of frames in which the camera moves within a pixel.
    pub jitter: Option<NonZeroU32>,
}

/// Makes the plan of a set of effects; no table at all gives the plain alpha test.
#[must_use]
pub fn plan(effects: &Effects) -> Plan {
    let places = effects.supersampling.as_ref().map_or(1, |s| s.samples.get());
    let coarsest = match (&effects.finest_level, &effects.limited_level) {
        (Some(_), _) => Some(0.0),
        (None, limited) => limited.as_ref().map(|limited| limited.level),
    };
    let space = effects.coordinates.as_ref().map_or(Space::Object, |coordinates| coordinates.space);
    let scaling = match (&effects.scaled_alpha, &effects.scaled_texels) {
        (Some(_), _) => Some(Scaling::Levels),
        (None, texels) => texels.as_ref().map(|texels| Scaling::Texels(texels.radius)),
    };
    let gaze = effects.foveated.as_ref().map(crate::render::effect::tables::Foveated::gaze);
    let multisamples = effects.multisampling.as_ref().map(|multisampling| multisampling.samples);
    let mut stages = vec![Stage::Rasterise(places)];
    stages.extend(effects.conservative.as_ref().map(|_| Stage::Touch));
    stages.extend(multisamples.map(Stage::Multisample));
    stages.extend(gaze.map(Stage::Foveate));
    stages.push(Stage::SampleAlpha(coarsest));
    stages.extend(scaling.map(Stage::Scaled));
    let again = stages.clone();
    let coverage = effects.alpha_to_coverage.as_ref();
    if effects.naive_blend.is_some() {
        stages.push(Stage::BlendAll);
    } else {
        stages.extend(source(effects, space));
    }
    if let Some(stipple) = &effects.stipple {
        stages.push(Stage::Stipple(stipple.density));
    }
    if let Some(independent) = &effects.independent {
        stages.push(Stage::Independent(independent.frames, independent.by));
    }
    if let Some(temporal) = &effects.temporal {
        stages.push(Stage::Stratify(temporal.frames, temporal.order));
    }
    if let Some(coverage) = coverage {
        stages.push(Stage::Coverage(coverage.samples, coverage.pattern));
    }
    if let Some(fade_in) = &effects.fade_in {
        stages.push(Stage::FadeIn(fade_in.clone()));
    }
    let unclamped =
        |stage: &Stage| matches!(stage, Stage::Fixed(_) | Stage::LevelThreshold | Stage::BlendAll);
    if !stages.iter().any(unclamped) {
        stages.push(Stage::Clamp);
    }
    if effects.conservative.as_ref().is_some_and(|conservative| conservative.corrected) {
        stages.push(Stage::Correct);
    }
    if effects.naive_blend.is_none() {
        stages.push(Stage::Test);
    }
    stages.extend(effects.occlusion.map(Stage::Occlude));
    if effects.naive_blend.is_none() {
        stages.push(Stage::Resolve { divide: effects.premultiplied.is_some() });
    }
    if effects.test_then_blend.is_some() {
        stages.extend(again);
        stages.push(Stage::Blend(
            effects.fixed.as_ref().map_or(FIXED_THRESHOLD as f32, |fixed| fixed.threshold),
        ));
    }
    if places > 1 {
        stages.push(Stage::Downsample(places));
    }
    if let Some(history) = &effects.history {
        stages.push(Stage::History(history.clone()));
    }
    if let Some(average) = &effects.average {
        stages.push(Stage::Average(average.frames));
    }
    let permuted = coverage.is_some_and(|c| matches!(c.pattern, Pattern::Decorrelated | Pattern::Random));
    Plan {
        name: effects.name.clone().unwrap_or_else(|| name(effects)),
        needs: Needs {
            footprint: stages.iter().any(|stage| matches!(stage, Stage::Hash(..) | Stage::Occlude(_))),
            texture_derivatives: coarsest != Some(0.0) || effects.fade_in.is_some(),
            layer: permuted || stages.contains(&Stage::ScreenDoor(Door::Hashed)),
            lod: effects.fade_in.is_some(),
            samples: multisamples,
            frame: [effects.temporal.is_some(), effects.stochastic.is_some()]
                .into_iter()
                .chain([effects.independent.is_some(), effects.jitter.is_some()])
                .chain(effects.occlusion.map(|occlusion| occlusion.chi == Chi::Random))
                .any(|reads| reads),
            pixel: permuted
                || coverage.is_some_and(|coverage| coverage.pattern == Pattern::Pixel)
                || stages.iter().any(|stage| matches!(stage, Stage::ScreenDoor(_) | Stage::Stipple(_))),
            coverage: effects.conservative.is_some(),
            depth: effects.history.as_ref().is_some_and(|history| history.reproject),
        },
        textures: TextureNeeds {
            premultiplied: effects.premultiplied.is_some(),
            thresholds: effects.level_threshold.is_some(),
            scaling,
        },
        jitter: effects.jitter.as_ref().map(|jitter| jitter.frames),
        gaze,
        stages,
        space,
        places,
        samples: coverage.map(|coverage| coverage.samples).or(multisamples).map_or(1, NonZeroU32::get),
    }
}

/// Where thresholds come from; none where the samples of a pixel have fixed ones.
fn source(effects: &Effects, space: Space) -> Option<Stage> {
    if let Some(hashed) = &effects.hashed {
        let model = HashedAlpha {
            variant: hashed.variant,
            hash: hashed.hash,
            hash_scale: hashed.hash_scale,
            form: hashed.form,
        };
        return Some(Stage::Hash(model.into(), space));
    }
    if let Some(robust) = &effects.robust {
        let preset = Robust::new(robust.variant);
        let model = Robust {
            hash: robust.hash,
            hash_scale: robust.hash_scale,
            join: robust.join.unwrap_or(preset.join),
            ..preset
        };
        return Some(Stage::Hash(model.into(), space));
    }
    if effects.level_threshold.is_some() {
        return Some(Stage::LevelThreshold);
    }
    if effects.stochastic.is_some() {
        return Some(Stage::Stochastic);
    }
    if let Some(door) = &effects.screen_door {
        return Some(Stage::ScreenDoor(door.mask));
    }
    if effects.alpha_to_coverage.is_some() {
        return None;
    }
    Some(Stage::Fixed(effects.fixed.as_ref().map_or(FIXED_THRESHOLD as f32, |fixed| fixed.threshold)))
}

/// A name made of the tables that are present.
fn name(effects: &Effects) -> String {
    let present: Vec<&str> =
        ALL.iter().filter(|known| (known.is_in)(effects)).map(|known| known.name).collect();
    if present.is_empty() { "alpha test".to_owned() } else { present.join(" + ") }
}

impl Plan {
    /// Returns what the stages cost in one frame.
    #[must_use]
    pub fn cost_of_frame(&self, census: Census) -> Cost {
        let Census { fragments, texels, pixels, shown } = census;
        let mut cost = Cost { frames: 1, ..Cost::default() };
        let mut thresholds = fragments;
        for stage in &self.stages {
            match stage {
                Stage::Rasterise(_) => {
                    cost.passes += 1;
                    cost.fragments += fragments;
                }
                Stage::SampleAlpha(_) => cost.texels += texels,
                Stage::Hash(model, _) => cost.hashes += fragments * hashes(model),
                Stage::Stochastic => cost.randoms += fragments,
                // Two for the order of the tile's strata, one within the pixel's own.
                Stage::ScreenDoor(Door::Hashed) => cost.hashes += 3 * fragments,
                Stage::Coverage(samples, pattern) => {
                    thresholds = fragments * u64::from(samples.get());
                    match pattern {
                        Pattern::Decorrelated | Pattern::Random | Pattern::Pixel => cost.hashes += fragments,
                        // The first of them is the one of the source.
                        Pattern::Independent => cost.randoms += thresholds - fragments,
                        Pattern::Regular | Pattern::Hardware | Pattern::Jittered => {}
                    }
                }
                Stage::Test => cost.tests += thresholds,
                Stage::Occlude(table) => cost += rays::cost(table, shown),
                Stage::Blend(_) | Stage::BlendAll => cost.blends += fragments,
                Stage::History(table) => {
                    cost.blends += pixels;
                    cost.projections += if table.reproject { pixels } else { 0 };
                }
                Stage::Average(_) => cost.blends += pixels,
                _ => {}
            }
        }
        cost
    }

    /// Predicts what all shots of a scene cost, from the fragments that its geometry makes; nothing is shaded. Only rays
    /// start where the alpha test lets a surface show: a plan with rays is drawn once without them. `progress` is told of every
    /// frame.
    pub fn predict(&self, scene: &Scene, textures: &[Texture], progress: &mut dyn FnMut()) -> Cost {
        let pixels = scene.file.resolution.map(u64::from).iter().product();
        let tested = self.before_rays();
        let mut cost = Cost::default();
        for shot in shots(scene) {
            for frame in 0..scene.file.frames.get() {
                let (fragments, texels) = self.census(scene, textures, &shot, frame);
                let shown = tested.as_ref().map_or(0, |tested| {
                    let drawn = frame::frame(scene, textures, tested, &shot, frame);
                    drawn.picture.coverage.iter().filter(|&&share| share > 0.0).count() as u64
                });
                cost += self.cost_of_frame(Census { fragments, texels, pixels, shown });
                progress();
            }
        }
        cost
    }

    /// The same at the places within pixels and without rays, if it has any.
    fn before_rays(&self) -> Option<Self> {
        let is_ray = |stage: &Stage| matches!(stage, Stage::Occlude(_));
        let whole = |stage: &&Stage| !is_ray(stage) && !matches!(stage, Stage::Downsample(_));
        let stages = self.stages.iter().filter(whole).cloned().collect();
        self.stages.iter().any(is_ray).then(|| Self { stages, ..self.clone() })
    }

    /// Counts the fragments of a frame and the texels that they read.
    fn census(&self, scene: &Scene, textures: &[Texture], shot: &Shot, frame: u32) -> (u64, u64) {
        let Needs { texture_derivatives, coverage, samples, .. } = self.needs;
        let needs = Needs { texture_derivatives, coverage, samples, ..Needs::default() };
        let camera = shot.camera(scene, frame, self.places);
        let screen =
            Screen::new(&scene.mesh, &camera, f64::from(frame), self.offset(frame), Space::Object, needs);
        (0..screen.tiles())
            .into_par_iter()
            .map_init(Fragments::default, |fragments, tile| {
                screen.fragments(tile, fragments);
                let (corner, _) = screen.tile(tile);
                let texels: u64 = (0..fragments.len())
                    .map(|at| {
                        let texture =
                            &textures[scene.mesh.triangles[fragments.triangle[at] as usize].texture as usize];
                        texture.texels(&self.access(texture, fragments, corner, at))
                    })
                    .sum();
                (fragments.len() as u64, texels)
            })
            .reduce(|| (0, 0), |a, b| (a.0 + b.0, a.1 + b.1))
    }

    /// Returns whether frames are mixed with those before.
    #[must_use]
    pub fn mixes(&self) -> bool {
        self.stages.iter().any(|stage| matches!(stage, Stage::History(_) | Stage::Average(_)))
    }

    /// Returns the number of frames after which the thresholds of a still scene repeat; `None` where they never do. The
    /// strata of samples, which Eq. 9 hashes, repeat with them.
    #[must_use]
    pub fn cycle(&self) -> Option<u64> {
        self.stages.iter().try_fold(1, |all: u64, stage| match stage {
            Stage::Stochastic => None,
            Stage::Stratify(frames, _) | Stage::Independent(frames, _) => {
                let frames = u64::from(frames.get());
                // The least number that both divide.
                (1..=frames).map(|times| times * all).find(|multiple| multiple % frames == 0)
            }
            _ => Some(all),
        })
    }

    /// Returns how far the image is moved in a frame, in pixels of the places.
    #[must_use]
    pub fn offset(&self, frame: u32) -> DVec2 {
        let jitter = self.jitter.map_or([0.0; 2], |frames| camera_jitter(frame, frames));
        DVec2::from(jitter) * f64::from(self.places)
    }

    /// Where a fragment of the tile whose upper left pixel is `corner` reads its texture.
    #[must_use]
    pub fn access(
        &self,
        texture: &Texture,
        fragments: &Fragments,
        corner: [u32; 2],
        at: usize,
    ) -> crate::render::draw::texture::Access {
        let [dtdx, dtdy] = if self.needs.texture_derivatives {
            [fragments.dtdx[at], fragments.dtdy[at]]
        } else {
            [glam::Vec2::ZERO; 2]
        };
        let mut access = texture.access(fragments.texcoord[at], dtdx, dtdy);
        if let Some(gaze) = &self.gaze {
            let pixel = u32::from(fragments.pixel[at]);
            let place = [corner[0] + pixel % TILE, corner[1] + pixel / TILE];
            let place = place.map(|along| (f64::from(along) + 0.5) / f64::from(self.places));
            access.lod += gaze.coarser_by(place) as f32;
        }
        for stage in &self.stages {
            if let Stage::SampleAlpha(Some(coarsest)) = stage {
                access.lod = access.lod.min(*coarsest);
            }
        }
        access
    }

    /// Returns the effects that do not run, each with the reason.
    pub fn skipped<'a>(
        &self,
        effects: &'a Effects,
    ) -> impl Iterator<Item = (&'static Known, &'static str)> + 'a {
        ALL.iter().filter(|known| !(known.is_in)(effects)).map(|known| (known, "the scene has no such table"))
    }
}
