//! The threshold of a plan as shader text.

use super::frame::DOOR_SEED;
use super::plan::Plan;
use crate::render::effect::stage::Stage;
use crate::render::effect::tables::{Door, FadeIn, Pattern};
use crate::shader::assemble::{self, InvalidOption, ShaderOptions, assemble};
use crate::shader::beside;
use crate::threshold::batch::Model;
use crate::threshold::fixed::FIXED_THRESHOLD;
use crate::threshold::two_scale::Variant;
use core::num::NonZeroU32;

impl Plan {
    /// Returns the threshold of the plan as WGSL, made of the chunks of its stages only, and after it the functions that the
    /// stages call beside it; `None` where no shader computes the threshold, as for independent draws at every sample or for
    /// what hardware does by itself.
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
                Stage::Hash(Model::BeforeCdf(_), _) => return Ok(None),
                Stage::Hash(Model::Robust(robust), _) => {
                    options.source = assemble::Source::Robust(robust.join);
                    (options.variant, options.hash) = (robust.variant, robust.hash);
                    options.hash_scale = Some(robust.hash_scale as f32);
                }
                Stage::Stratify(frames, order) => {
                    options.stratify = Some(assemble::Stratify { frames: short(frames), order: *order });
                }
                Stage::ScreenDoor(door) => {
                    options.source = assemble::Source::ScreenDoor(match door {
                        Door::Fixed => assemble::ScreenDoor::Fixed,
                        Door::Random => assemble::ScreenDoor::RandomMask(DOOR_SEED),
                        Door::Hashed => assemble::ScreenDoor::Randomised,
                    });
                }
                Stage::Stipple(density) => options.source = assemble::Source::Stipple(*density),
                // Hardware does its own without a shader.
                Stage::Coverage(_, Pattern::Independent | Pattern::Hardware) => return Ok(None),
                Stage::Coverage(samples, Pattern::Regular) => {
                    options.source = assemble::Source::Regular(short(samples));
                }
                Stage::Coverage(samples, Pattern::Pixel) => {
                    options.source = assemble::Source::PixelMask(short(samples));
                }
                Stage::Coverage(samples, pattern) => {
                    let strata = match pattern {
                        Pattern::Decorrelated => assemble::Strata::Decorrelated,
                        Pattern::Random => assemble::Strata::Shuffled,
                        _ => assemble::Strata::InOrder,
                    };
                    options.coverage = Some(assemble::Coverage { samples: short(samples), strata });
                }
                Stage::FadeIn(fade_in) if !is_traditional(fade_in.authored) => return Ok(None),
                Stage::FadeIn(fade_in) => {
                    let FadeIn { full_noise_lod, anisotropy, .. } = *fade_in;
                    options.fade_in = Some(assemble::FadeIn { full_noise_lod, anisotropy });
                }
                Stage::Independent(..) | Stage::LevelThreshold | Stage::BlendAll => return Ok(None),
                _ => {}
            }
        }
        let mut text = assemble(&options)?;
        for stage in &self.stages {
            match stage {
                Stage::Foveate(_) => text.push_str(beside::COARSER_BY),
                Stage::Occlude(_) => text.push_str(beside::COSINE_DIRECTION),
                Stage::Correct => text.push_str(beside::CORRECTED),
                _ => {}
            }
        }
        Ok(Some(text))
    }
}

/// Whether shader text, which knows the traditional threshold only, can have this one.
fn is_traditional(threshold: f32) -> bool {
    (f64::from(threshold) - FIXED_THRESHOLD).abs() < f64::EPSILON
}
