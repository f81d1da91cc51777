//! From the effects of a take to the ordered stages that simulate them, with what they need and what they cost.
//!
//! A plan is the program that a run carries out: what is not in its stages does not happen, and what no stage needs is
//! not computed.

use super::adjust::Scaling;
use super::cost::Cost;
use super::effects::{ALL, Effects, FadeIn, History, Known, Pattern, Space};
use super::fragments::{Fragments, Needs};
use super::prepare::Scene;
use super::rasterise::Screen;
use super::study::{Shot, shots};
use super::texture::Texture;
use crate::shader::assemble::{self, InvalidOption, ShaderOptions, assemble};
use crate::technique::jitter::camera_jitter;
use crate::technique::order::Order;
use crate::threshold::batch::Model;
use crate::threshold::fixed::FIXED_THRESHOLD;
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::robust::{Join, Robust};
use crate::threshold::two_scale::Variant;
use core::num::NonZeroU32;
use glam::DVec2;
use rayon::prelude::*;

/// One stage of a plan.
#[derive(Clone, Debug, PartialEq)]
pub enum Stage {
    /// Triangles to fragments, at so many places along each side of a pixel.
    Rasterise(u32),
    /// Filtered alpha, from no level coarser than the given one if any.
    SampleAlpha(Option<f32>),
    /// Alphas as they were scaled beforehand.
    Scaled(Scaling),
    /// One threshold for all fragments.
    Fixed(f32),
    /// The threshold of the level that is read.
    LevelThreshold,
    /// A fresh threshold a fragment, or so many.
    Stochastic,
    /// A hashed threshold.
    Hash(Model, Space),
    /// The same at another place in each of so many frames.
    Independent(NonZeroU32),
    /// The stratum of the frame.
    Stratify(NonZeroU32, Order),
    /// The strata of the samples.
    Coverage(NonZeroU32, Pattern),
    /// The mixture with the threshold without noise, by level of detail.
    FadeIn(FadeIn),
    /// The range (0, 1], after all that changes thresholds.
    Clamp,
    /// Alpha against threshold.
    Test,
    /// The nearest fragment that is kept, at each sample; its colour, divided by alpha where that was multiplied in.
    Resolve {
        /// Whether colours are divided by alpha.
        divide: bool,
    },
    /// What failed the test with a threshold, blended over what passed it.
    Blend(f32),
    /// The mean of the places within a pixel.
    Downsample(u32),
    /// The exponential average of all frames.
    History(History),
    /// The mean of the last frames.
    Average(NonZeroU32),
}

impl Stage {
    /// Returns the effect that it simulates, by the name of its table; `None` for what every plan has.
    #[must_use]
    pub fn effect(&self) -> Option<&'static str> {
        match self {
            Self::Rasterise(1) | Self::SampleAlpha(None) | Self::Clamp | Self::Test => None,
            Self::Resolve { divide: false } => None,
            Self::Rasterise(_) | Self::Downsample(_) => Some("supersampling"),
            Self::SampleAlpha(Some(level)) if *level <= 0.0 => Some("finest_level"),
            Self::SampleAlpha(Some(_)) => Some("limited_level"),
            Self::Fixed(_) => Some("fixed"),
            Self::Stochastic => Some("stochastic"),
            Self::Hash(Model::Hashed(_), _) => Some("hashed"),
            Self::Hash(Model::Robust(_), _) => Some("robust"),
            Self::Stratify(..) => Some("temporal"),
            Self::Coverage(..) => Some("alpha_to_coverage"),
            Self::FadeIn(_) => Some("fade_in"),
            Self::Scaled(Scaling::Levels) => Some("scaled_alpha"),
            Self::Scaled(Scaling::Texels(_)) => Some("scaled_texels"),
            Self::LevelThreshold => Some("level_threshold"),
            Self::Independent(_) => Some("independent"),
            Self::Blend(_) => Some("test_then_blend"),
            Self::History(_) => Some("history"),
            Self::Resolve { divide: true } => Some("premultiplied"),
            Self::Average(_) => Some("average"),
        }
    }

    /// Says what it does, in a line.
    #[must_use]
    pub fn describe(&self) -> String {
        match self {
            Self::Rasterise(1) => "rasterise: fragments of every surface, once a pixel".to_owned(),
            Self::Rasterise(side) => {
                format!("rasterise: fragments of every surface, {side} x {side} a pixel")
            }
            Self::SampleAlpha(None) => "sample alpha: at the level of the footprint".to_owned(),
            Self::SampleAlpha(Some(level)) => format!("sample alpha: no coarser than level {level}"),
            Self::Fixed(threshold) => format!("threshold: {threshold} for all"),
            Self::Stochastic => "threshold: drawn anew in every fragment and frame".to_owned(),
            Self::Hash(Model::Hashed(h), space) => format!(
                "hash: {} listing, {} hash, noise of {} px, {} coordinates",
                h.variant,
                h.hash,
                h.hash_scale,
                space.name()
            ),
            Self::Hash(Model::Robust(r), space) => format!(
                "hash: robust {}, {} hash, {} join, noise of {} px, {} coordinates",
                r.variant,
                r.hash,
                r.join,
                r.hash_scale,
                space.name()
            ),
            Self::Stratify(frames, order) => {
                format!("temporal: stratum of {frames} frames, {} order", order.name())
            }
            Self::Coverage(samples, pattern) => {
                format!("coverage: {samples} samples a pixel, {} strata", pattern.name())
            }
            Self::FadeIn(fade_in) => {
                let scaled = if fade_in.anisotropy { ", scaled by anisotropy" } else { "" };
                let (level, authored) = (fade_in.full_noise_lod, fade_in.authored);
                format!("fade in: from {authored} at level 0 to full noise at level {level}{scaled}")
            }
            Self::Scaled(Scaling::Levels) => "adjust alpha: scaled for each level, beforehand".to_owned(),
            Self::Scaled(Scaling::Texels(radius)) => {
                format!("adjust alpha: scaled for each texel by those within {radius}, beforehand")
            }
            Self::LevelThreshold => "threshold: that of the level, found beforehand".to_owned(),
            Self::Independent(frames) => format!("hash: at another place in each of {frames} frames"),
            Self::Blend(threshold) => format!("blend: what failed at {threshold}, over what passed"),
            Self::History(history) => {
                let clamped = if history.clamp { ", clamped to its neighbourhood" } else { "" };
                format!("history: {} of the newest frame, the rest of those before{clamped}", history.weight)
            }
            Self::Clamp => "clamp: into [2^-24, 1], last".to_owned(),
            Self::Test => "test: keep where alpha >= threshold".to_owned(),
            Self::Resolve { divide: false } => "resolve: the nearest that is kept".to_owned(),
            Self::Resolve { divide: true } => {
                "resolve: the nearest that is kept, colour divided by alpha".to_owned()
            }
            Self::Downsample(side) => format!("downsample: mean of {side} x {side}"),
            Self::Average(frames) => format!("average: mean of the last {frames} frames"),
        }
    }
}

impl Space {
    /// The name of the coordinates.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Object => "object",
            Self::Deformed => "deformed object",
            Self::Part => "part",
            Self::World => "world",
            Self::Texture => "texture",
            Self::Eye => "eye",
            Self::Screen => "screen",
            Self::Device => "device",
        }
    }
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
    /// Tests a fragment.
    pub samples: u32,
    /// What it needs of textures.
    pub textures: TextureNeeds,
    /// The number of frames in which the camera moves within a pixel.
    pub jitter: Option<NonZeroU32>,
}

/// What a plan needs of textures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TextureNeeds {
    /// Colours multiplied by alpha.
    pub premultiplied: bool,
    /// A threshold for each level.
    pub thresholds: bool,
    /// Scaled alphas.
    pub scaling: Option<Scaling>,
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
    let mut stages = vec![Stage::Rasterise(places), Stage::SampleAlpha(coarsest)];
    stages.extend(scaling.map(Stage::Scaled));
    let again = stages.clone();
    let coverage = effects.alpha_to_coverage.as_ref();
    stages.extend(source(effects, space));
    if let Some(independent) = &effects.independent {
        stages.push(Stage::Independent(independent.frames));
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
    if !stages.iter().any(|stage| matches!(stage, Stage::Fixed(_) | Stage::LevelThreshold)) {
        stages.push(Stage::Clamp);
    }
    stages.extend([Stage::Test, Stage::Resolve { divide: effects.premultiplied.is_some() }]);
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
    let decorrelated = coverage.is_some_and(|coverage| coverage.pattern == Pattern::Decorrelated);
    Plan {
        name: effects.name.clone().unwrap_or_else(|| name(effects)),
        needs: Needs {
            footprint: stages.iter().any(|stage| matches!(stage, Stage::Hash(..))),
            texture_derivatives: coarsest != Some(0.0) || effects.fade_in.is_some(),
            layer: decorrelated,
            lod: effects.fade_in.is_some(),
            frame: [effects.temporal.is_some(), effects.stochastic.is_some(), decorrelated]
                .into_iter()
                .chain([effects.independent.is_some(), effects.jitter.is_some()])
                .any(|reads| reads),
        },
        textures: TextureNeeds {
            premultiplied: effects.premultiplied.is_some(),
            thresholds: effects.level_threshold.is_some(),
            scaling,
        },
        jitter: effects.jitter.as_ref().map(|jitter| jitter.frames),
        stages,
        space,
        places,
        samples: coverage.map_or(1, |coverage| coverage.samples.get()),
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
    if effects.alpha_to_coverage.is_some() {
        return None;
    }
    Some(Stage::Fixed(effects.fixed.as_ref().map_or(FIXED_THRESHOLD as f32, |fixed| fixed.threshold)))
}

/// Whether shader text, which knows the traditional threshold only, can have this one.
fn is_traditional(threshold: f32) -> bool {
    (f64::from(threshold) - FIXED_THRESHOLD).abs() < f64::EPSILON
}

/// A name made of the tables that are present.
fn name(effects: &Effects) -> String {
    let present: Vec<&str> =
        ALL.iter().filter(|known| (known.is_in)(effects)).map(|known| known.name).collect();
    if present.is_empty() { "alpha test".to_owned() } else { present.join(" + ") }
}

/// The number of hashes that a model computes for one threshold.
#[must_use]
pub fn hashes(model: &Model) -> u64 {
    let anisotropic = |variant: Variant| variant == Variant::Anisotropic;
    match model {
        Model::Hashed(hashed) => {
            if hashed.variant == Variant::Single {
                1
            } else {
                2
            }
        }
        Model::Robust(robust) => match robust.join {
            Join::Interpolate => 2,
            Join::Copula => {
                if anisotropic(robust.variant) {
                    8
                } else {
                    2
                }
            }
            Join::Dithered => {
                if anisotropic(robust.variant) {
                    4
                } else {
                    2
                }
            }
        },
    }
}

impl Plan {
    /// Returns what the stages cost in one frame of `pixels` pixels with so many fragments, which read so many texels when
    /// all are read once.
    #[must_use]
    pub fn cost_of_frame(&self, fragments: u64, texels: u64, pixels: u64) -> Cost {
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
                Stage::Coverage(samples, pattern) => {
                    thresholds = fragments * u64::from(samples.get());
                    match pattern {
                        Pattern::Decorrelated => cost.hashes += fragments,
                        // The first of them is the one of the source.
                        Pattern::Independent => cost.randoms += thresholds - fragments,
                        Pattern::Regular | Pattern::Jittered => {}
                    }
                }
                Stage::Test => cost.tests += thresholds,
                Stage::Blend(_) => cost.blends += fragments,
                Stage::History(_) | Stage::Average(_) => cost.blends += pixels,
                _ => {}
            }
        }
        cost
    }

    /// Predicts what all shots of a scene cost, from the fragments that its geometry makes; nothing is shaded.
    #[must_use]
    pub fn predict(&self, scene: &Scene, textures: &[Texture]) -> Cost {
        let pixels = scene.file.resolution.map(u64::from).iter().product();
        let mut cost = Cost::default();
        for shot in shots(scene) {
            for frame in 0..scene.file.frames.get() {
                let (fragments, texels) = self.census(scene, textures, &shot, frame);
                cost += self.cost_of_frame(fragments, texels, pixels);
            }
        }
        cost
    }

    /// Counts the fragments of a frame and the texels that they read.
    fn census(&self, scene: &Scene, textures: &[Texture], shot: &Shot, frame: u32) -> (u64, u64) {
        let needs = Needs { texture_derivatives: self.needs.texture_derivatives, ..Needs::default() };
        let camera = shot.camera(scene, frame, self.places);
        let screen =
            Screen::new(&scene.mesh, &camera, f64::from(frame), self.offset(frame), Space::Object, needs);
        (0..screen.tiles())
            .into_par_iter()
            .map_init(Fragments::default, |fragments, tile| {
                screen.fragments(tile, fragments);
                let texels: u64 = (0..fragments.len())
                    .map(|at| {
                        let texture =
                            &textures[scene.mesh.triangles[fragments.triangle[at] as usize].texture as usize];
                        texture.texels(&self.access(texture, fragments, at))
                    })
                    .sum();
                (fragments.len() as u64, texels)
            })
            .reduce(|| (0, 0), |a, b| (a.0 + b.0, a.1 + b.1))
    }

    /// Returns how far the image is moved in a frame, in pixels of the places.
    #[must_use]
    pub fn offset(&self, frame: u32) -> DVec2 {
        let jitter = self.jitter.map_or([0.0; 2], |frames| camera_jitter(frame, frames));
        DVec2::from(jitter) * f64::from(self.places)
    }

    /// Where a fragment reads its texture.
    #[must_use]
    pub fn access(&self, texture: &Texture, fragments: &Fragments, at: usize) -> super::texture::Access {
        let [dtdx, dtdy] = if self.needs.texture_derivatives {
            [fragments.dtdx[at], fragments.dtdy[at]]
        } else {
            [glam::Vec2::ZERO; 2]
        };
        let mut access = texture.access(fragments.texcoord[at], dtdx, dtdy);
        for stage in &self.stages {
            if let Stage::SampleAlpha(Some(coarsest)) = stage {
                access.lod = access.lod.min(*coarsest);
            }
        }
        access
    }

    /// Returns the effects that do not run, each with the reason.
    #[must_use]
    pub fn skipped<'a>(
        &self,
        effects: &'a Effects,
    ) -> impl Iterator<Item = (&'static Known, &'static str)> + 'a {
        ALL.iter().filter(|known| !(known.is_in)(effects)).map(|known| (known, "the scene has no such table"))
    }

    /// Returns the threshold of the plan as WGSL, made of the chunks of its stages only; `None` where no shader computes
    /// one, as for independent draws at every sample.
    ///
    /// # Errors
    ///
    /// [`InvalidOption`] for numbers that cannot be written as text.
    pub fn shader(&self) -> Result<Option<String>, InvalidOption> {
        let mut options =
            ShaderOptions { source: assemble::Source::Fixed, ..ShaderOptions::listing(Variant::Isotropic) };
        let short =
            |n: &NonZeroU32| core::num::NonZeroU16::try_from(*n).unwrap_or(core::num::NonZeroU16::MAX);
        for stage in &self.stages {
            match stage {
                Stage::Fixed(threshold) if !is_traditional(*threshold) => return Ok(None),
                Stage::Stochastic => options.source = assemble::Source::Stochastic,
                Stage::Hash(Model::Hashed(hashed), _) => {
                    options.source = assemble::Source::Listing(hashed.form);
                    (options.variant, options.hash) = (hashed.variant, hashed.hash);
                    options.hash_scale = Some(hashed.hash_scale as f32);
                }
                Stage::Hash(Model::Robust(robust), _) => {
                    options.source = assemble::Source::Robust(robust.join);
                    (options.variant, options.hash) = (robust.variant, robust.hash);
                    options.hash_scale = Some(robust.hash_scale as f32);
                }
                Stage::Stratify(_, order) if !matches!(order, Order::Ascending | Order::Alternating) => {
                    return Ok(None);
                }
                Stage::Stratify(frames, order) => {
                    options.stratify = Some(assemble::Stratify {
                        frames: short(frames),
                        alternating: *order == Order::Alternating,
                    });
                }
                Stage::Coverage(_, Pattern::Independent) => return Ok(None),
                Stage::Coverage(samples, Pattern::Regular) => {
                    options.source = assemble::Source::Regular(short(samples));
                }
                Stage::Coverage(samples, pattern) => {
                    options.coverage = Some(assemble::Coverage {
                        samples: short(samples),
                        decorrelated: *pattern == Pattern::Decorrelated,
                    });
                }
                Stage::FadeIn(fade_in) if !is_traditional(fade_in.authored) => return Ok(None),
                Stage::FadeIn(fade_in) => {
                    let FadeIn { full_noise_lod, anisotropy, .. } = *fade_in;
                    options.fade_in = Some(assemble::FadeIn { full_noise_lod, anisotropy });
                }
                Stage::Independent(_) | Stage::LevelThreshold => return Ok(None),
                _ => {}
            }
        }
        assemble(&options).map(Some)
    }
}
