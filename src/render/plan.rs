//! From the effects of a take to the ordered stages that simulate them, with what they need and what they cost.
//!
//! A plan is the program that a run carries out: what is not in its stages does not happen, and what no stage needs is
//! not computed.

use super::cost::Cost;
use super::effects::{ALL, Effects, Known, Order, Pattern, Space};
use super::fragments::{Fragments, Needs};
use super::prepare::Scene;
use super::rasterise::Screen;
use super::study::{Shot, shots};
use super::texture::Texture;
use crate::shader::assemble::{self, InvalidOption, ShaderOptions, assemble};
use crate::threshold::batch::Model;
use crate::threshold::fixed::FIXED_THRESHOLD;
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::robust::{Join, Robust};
use crate::threshold::two_scale::Variant;
use core::num::NonZeroU32;
use rayon::prelude::*;

/// One stage of a plan.
#[derive(Clone, Debug, PartialEq)]
pub enum Stage {
    /// Triangles to fragments, at so many places along each side of a pixel.
    Rasterise(u32),
    /// Filtered alpha, from no level coarser than the given one if any.
    SampleAlpha(Option<f32>),
    /// One threshold for all fragments.
    Fixed(f32),
    /// A fresh threshold a fragment, or so many.
    Stochastic,
    /// A hashed threshold.
    Hash(Model, Space),
    /// The stratum of the frame.
    Stratify(NonZeroU32, Order),
    /// The strata of the samples.
    Coverage(NonZeroU32, Pattern),
    /// The mixture with the traditional threshold, by level of detail; and whether anisotropy scales it.
    FadeIn(f32, bool),
    /// The range (0, 1], after all that changes thresholds.
    Clamp,
    /// Alpha against threshold.
    Test,
    /// The nearest fragment that is kept, at each sample; its colour, divided by alpha where that was multiplied in.
    Resolve {
        /// Whether colours are divided by alpha.
        divide: bool,
    },
    /// The mean of the places within a pixel.
    Downsample(u32),
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
            Self::FadeIn(..) => Some("fade_in"),
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
                "hash: {} listing, {} hash, {} pixels, {} coordinates",
                h.variant,
                h.hash,
                h.hash_scale,
                space.name()
            ),
            Self::Hash(Model::Robust(r), space) => format!(
                "hash: robust {}, {} hash, {} join, {} pixels, {} coordinates",
                r.variant,
                r.hash,
                r.join,
                r.hash_scale,
                space.name()
            ),
            Self::Stratify(frames, order) => format!("temporal: stratum of {frames} frames, {order:?} order"),
            Self::Coverage(samples, pattern) => {
                format!("coverage: {samples} samples a pixel, {pattern:?} strata")
            }
            Self::FadeIn(lod, false) => format!("fade in: full noise from level {lod}"),
            Self::FadeIn(lod, true) => format!("fade in: full noise from level {lod}, scaled by anisotropy"),
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
    let mut stages = vec![Stage::Rasterise(places), Stage::SampleAlpha(coarsest)];
    let coverage = effects.alpha_to_coverage.as_ref();
    stages.extend(source(effects, space));
    if let Some(temporal) = &effects.temporal {
        stages.push(Stage::Stratify(temporal.frames, temporal.order));
    }
    if let Some(coverage) = coverage {
        stages.push(Stage::Coverage(coverage.samples, coverage.pattern));
    }
    if let Some(fade_in) = &effects.fade_in {
        stages.push(Stage::FadeIn(fade_in.full_noise_lod, fade_in.anisotropy));
    }
    if !stages.iter().any(|stage| matches!(stage, Stage::Fixed(_))) {
        stages.push(Stage::Clamp);
    }
    stages.extend([Stage::Test, Stage::Resolve { divide: effects.premultiplied.is_some() }]);
    if places > 1 {
        stages.push(Stage::Downsample(places));
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
            frame: effects.temporal.is_some() || effects.stochastic.is_some() || decorrelated,
        },
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
    if effects.stochastic.is_some() {
        return Some(Stage::Stochastic);
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

/// What a pass that rasterises a scene at some place of its motion costs; the counts that follow from fragments alone.
impl Plan {
    /// Returns what the stages cost for so many fragments, of which `texels` are read, in one frame of `pixels`.
    #[must_use]
    pub fn cost_of_frame(&self, fragments: u64, texels: u64, pixels: u64) -> Cost {
        let mut cost = Cost { frames: 1, passes: 1, fragments, ..Cost::default() };
        let mut thresholds = fragments;
        for stage in &self.stages {
            match stage {
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
                Stage::Average(_) => cost.blends += pixels,
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
        let screen = Screen::new(&scene.mesh, &camera, f64::from(frame), Space::Object, needs);
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
                Stage::Fixed(threshold) if f64::from(*threshold) != FIXED_THRESHOLD => return Ok(None),
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
                Stage::FadeIn(full_noise_lod, anisotropy) => {
                    options.fade_in =
                        Some(assemble::FadeIn { full_noise_lod: *full_noise_lod, anisotropy: *anisotropy });
                }
                _ => {}
            }
        }
        assemble(&options).map(Some)
    }
}
