//! The threshold of a plan as shader text.

use super::frame::DOOR_SEED;
use super::plan::Plan;
use crate::render::effect::stage::Stage;
use crate::render::effect::tables::{Apart, Door, FadeIn, Pattern};
use crate::shader::assemble::{AssembleError, assemble};
use crate::shader::beside;
use crate::threshold::cdf::CdfForm;
use crate::threshold::model::Model;
use crate::threshold::pipeline::{
    self, FrameStrata, Independence, IndependentBy, Pipeline, SamplePattern, SampleStrata, ScreenDoor, Source,
};

impl Plan {
    /// Returns the source and the stages of the plan's thresholds.
    #[must_use]
    pub fn pipeline(&self) -> Pipeline {
        let mut pipeline = Pipeline::from(Source::Fixed(0.5));
        for stage in &self.stages {
            match stage {
                Stage::Fixed(threshold) => pipeline.source = Source::Fixed(*threshold),
                Stage::LevelThreshold => pipeline.source = Source::Given,
                Stage::Stochastic => pipeline.source = Source::Stochastic,
                Stage::Hash(model, _) => pipeline.source = Source::Hash(*model),
                Stage::ScreenDoor(door) => {
                    pipeline.source = Source::ScreenDoor(match door {
                        Door::Fixed => ScreenDoor::Fixed,
                        Door::Random => ScreenDoor::RandomMask(DOOR_SEED),
                        Door::Hashed => ScreenDoor::Randomised,
                    });
                }
                Stage::Stipple(density) => {
                    let Source::Fixed(kept) = pipeline.source else { continue };
                    pipeline.source = Source::Stipple { density: *density, kept };
                }
                Stage::Independent(frames, by) => {
                    let by = match by {
                        Apart::Offset => IndependentBy::Offset,
                        Apart::Word => IndependentBy::Word,
                    };
                    pipeline.independence = Some(Independence { frames: *frames, by });
                }
                Stage::Stratify(frames, order) => {
                    pipeline.frame_strata = Some(FrameStrata { frames: *frames, order: *order });
                }
                Stage::Coverage(samples, pattern) => {
                    let pattern = match pattern {
                        Pattern::Regular => SamplePattern::Regular,
                        Pattern::Jittered => SamplePattern::Jittered,
                        Pattern::Decorrelated => SamplePattern::Decorrelated,
                        Pattern::Independent => SamplePattern::Independent,
                        Pattern::Hardware => SamplePattern::Hardware,
                        Pattern::Random => SamplePattern::Shuffled,
                        Pattern::Pixel => SamplePattern::ByPixel,
                    };
                    pipeline.sample_strata = Some(SampleStrata { samples: *samples, pattern });
                }
                Stage::FadeIn(FadeIn { full_noise_lod, anisotropy, authored }) => {
                    pipeline.fade_in = Some(pipeline::FadeIn {
                        authored: *authored,
                        full_noise_lod: *full_noise_lod,
                        anisotropy: *anisotropy,
                    });
                }
                _ => {}
            }
        }
        pipeline
    }

    /// Returns the threshold of the plan as WGSL, made of the chunks of its stages only, and after it the functions that the
    /// stages call beside it; `None` where there is no such text, as for independent draws at every sample or for what
    /// hardware does by itself. After a listing to the letter all is to the letter.
    ///
    /// # Errors
    ///
    /// [`AssembleError`] for numbers that cannot be written as text.
    pub fn shader(&self) -> Result<Option<String>, AssembleError> {
        if self.stages.contains(&Stage::BlendAll) {
            return Ok(None);
        }
        let mut pipeline = self.pipeline();
        if let Source::Hash(Model::Hashed(hashed)) = pipeline.source {
            pipeline.form = hashed.form;
        } else if pipeline.source == Source::Stochastic {
            pipeline.form = CdfForm::Literal;
        }
        let mut text = match assemble(pipeline) {
            Err(AssembleError::NoText(_)) => return Ok(None),
            text => text?,
        };
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
