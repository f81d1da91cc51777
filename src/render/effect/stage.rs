//! The stages of which plans are made.

use super::tables::{Apart, Chi, Door, FadeIn, History, Occlusion, Pattern};
use crate::render::draw::fragments::Space;
use crate::render::draw::texture::Scaling;
use crate::technique::foveated::Gaze;
use crate::threshold::batch::Model;
use crate::threshold::robust::Join;
use crate::threshold::stage::order::Order;
use crate::threshold::stage::stipple::Density;
use crate::threshold::two_scale::Variant;
use core::num::NonZeroU32;

/// One stage of a plan.
#[derive(Clone, Debug, PartialEq)]
pub enum Stage {
    /// Triangles to fragments, at so many places along each side of a pixel.
    Rasterise(u32),
    /// The same for every pixel that a triangle touches.
    Touch,
    /// Coarser levels away from a point of the image.
    Foveate(Gaze),
    /// Geometry at so many places of each pixel.
    Multisample(NonZeroU32),
    /// Filtered alpha, from no level coarser than the given one if any.
    SampleAlpha(Option<f32>),
    /// Alphas as they were scaled beforehand.
    Scaled(Scaling),
    /// One threshold for all fragments.
    Fixed(f32),
    /// The threshold of the level that is read.
    LevelThreshold,
    /// The threshold of the pixel's place in a tile.
    ScreenDoor(Door),
    /// A threshold that only opaque fragments reach, where the stipple has a hole.
    Stipple(Density),
    /// A fresh threshold a fragment, or so many.
    Stochastic,
    /// A hashed threshold.
    Hash(Model, Space),
    /// The same, apart in each of so many frames.
    Independent(NonZeroU32, Apart),
    /// The stratum of the frame.
    Stratify(NonZeroU32, Order),
    /// The strata of the samples.
    Coverage(NonZeroU32, Pattern),
    /// The mixture with the threshold without noise, by level of detail.
    FadeIn(FadeIn),
    /// The range (0, 1], after all that changes thresholds.
    Clamp,
    /// Thresholds over the share of the pixel that the surface covers.
    Correct,
    /// Alpha against threshold.
    Test,
    /// One ray from the nearest fragment that is kept.
    Occlude(Occlusion),
    /// The nearest fragment that is kept, at each sample; its colour, divided by alpha where that was multiplied in.
    Resolve {
        /// Whether colours are divided by alpha.
        divide: bool,
    },
    /// What failed the test with a threshold, blended over what passed it.
    Blend(f32),
    /// Every fragment blended in the order in which it comes, with depth.
    BlendAll,
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
            Self::Multisample(_) => Some("multisampling"),
            Self::SampleAlpha(Some(level)) if *level <= 0.0 => Some("finest_level"),
            Self::SampleAlpha(Some(_)) => Some("limited_level"),
            Self::Touch | Self::Correct => Some("conservative"),
            Self::Foveate(_) => Some("foveated"),
            Self::Occlude(_) => Some("occlusion"),
            // The plain alpha test is what a plan has without any table.
            Self::Fixed(0.5) => None,
            Self::Fixed(_) => Some("fixed"),
            Self::Stochastic => Some("stochastic"),
            Self::ScreenDoor(_) => Some("screen_door"),
            Self::Stipple(_) => Some("stipple"),
            Self::Hash(Model::Hashed(_) | Model::BeforeCdf(_), _) => Some("hashed"),
            Self::Hash(Model::Robust(_), _) => Some("robust"),
            Self::Stratify(..) => Some("temporal"),
            Self::Coverage(..) => Some("alpha_to_coverage"),
            Self::FadeIn(_) => Some("fade_in"),
            Self::Scaled(Scaling::Levels) => Some("scaled_alpha"),
            Self::Scaled(Scaling::Texels(_)) => Some("scaled_texels"),
            Self::LevelThreshold => Some("level_threshold"),
            Self::Independent(..) => Some("independent"),
            Self::Blend(_) => Some("test_then_blend"),
            Self::BlendAll => Some("naive_blend"),
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
            Self::Touch => "rasterise: every pixel that a triangle touches".to_owned(),
            Self::Foveate(Gaze { centre: [x, y], radius, slope }) => format!(
                "foveate: samples of 1 px within {radius} px of ({x}, {y}), beyond that {slope} px more a pixel"
            ),
            Self::Occlude(Occlusion { reach, chi, variant }) => {
                let from = match chi {
                    Chi::TwoHashes => format!("two hashes of the {variant} listing"),
                    Chi::Offsets => format!("two offsets of the {variant} listing"),
                    Chi::Word => format!("two words of the robust {variant} threshold"),
                    Chi::Seeded => format!("a generator seeded by the coarse cell, {variant}"),
                    Chi::Random => "fresh random numbers".to_owned(),
                };
                format!(
                    "occlude: one ray from the nearest that is kept, up to {reach} units, by {from}; triangles are solid"
                )
            }
            Self::Correct => "correct: thresholds over the share of the pixel, those above 1 too".to_owned(),
            Self::Multisample(samples) => {
                format!("multisample: geometry at {samples} places of each pixel, alpha at one")
            }
            Self::SampleAlpha(None) => "sample alpha: at the level of the footprint".to_owned(),
            Self::SampleAlpha(Some(level)) => format!("sample alpha: no coarser than level {level}"),
            Self::Fixed(threshold) => format!("threshold: {threshold} for all"),
            Self::Stochastic => "threshold: drawn anew in every fragment and frame".to_owned(),
            Self::ScreenDoor(door) => {
                format!("threshold: that of the pixel in a {} mask of 4 x 4", door.name())
            }
            Self::Stipple(Density::High) => "stipple: a hole in one pixel of 2 x 2".to_owned(),
            Self::Stipple(Density::Low) => "stipple: a hole in three pixels of 2 x 2".to_owned(),
            Self::Hash(Model::Hashed(h) | Model::BeforeCdf(h), space) => format!(
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
                format!("coverage: {samples} samples a pixel, {} pattern", pattern.name())
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
            Self::Independent(frames, Apart::Offset) => {
                format!("hash: at another place in each of {frames} frames")
            }
            Self::Independent(frames, Apart::Word) => {
                format!("hash: with another word in each of {frames} frames")
            }
            Self::Blend(threshold) => format!("blend: what failed at {threshold}, over what passed"),
            Self::BlendAll => {
                "blend: every fragment as it comes, each hiding what comes later behind it".to_owned()
            }
            Self::History(history) => {
                let clamped = if history.clamp { ", clamped to its neighbourhood" } else { "" };
                let moved = if history.reproject { " where the camera has left them" } else { "" };
                format!(
                    "history: {} of the newest frame, the rest of those before{moved}{clamped}",
                    history.weight
                )
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

/// The number of hashes that a model computes for one threshold.
#[must_use]
pub fn hashes(model: &Model) -> u64 {
    let anisotropic = |variant: Variant| variant == Variant::Anisotropic;
    match model {
        Model::Hashed(hashed) | Model::BeforeCdf(hashed) => {
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
