//! What is done to a frame, stage by stage, with what it says, costs, and becomes in a shader.
//!
//! A plan is the program that a run carries out: what is not in its stages does not happen, and what no stage needs is
//! not computed. Its stages are of three kinds: those before shading change the [`Setup`]; those in it change the columns
//! of a tile; those after it change whole pictures.

use super::cost::{Census, Cost, Per};
use super::setup::Setup;
use super::work::{Frame, Shading, TileResult, Work};
use crate::render::measure::picture::Picture;
use crate::scene::Camera;
use crate::shader::assemble::{AssembleError, assemble};
use crate::threshold::cdf::CdfForm;
use crate::threshold::model::Model;
use crate::threshold::pipeline::Source;
use glam::DVec2;
use std::collections::VecDeque;
use std::sync::Arc;

/// What every stage must tell of itself, whatever its kind.
#[derive(Clone, Debug)]
pub struct Told {
    /// The effect that it simulates, by the name of its table; `None` for what every plan has.
    pub effect: Option<&'static str>,
    /// What it does, in a line.
    pub says: String,
    /// What it costs.
    pub price: Vec<(Per, Cost)>,
    /// What a shader has of it.
    pub text: Text,
}

/// What the text of a shader has of a stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Text {
    /// Nothing of its own: a stage outside of shaders, or one that the pipeline of thresholds has.
    None,
    /// A function that the shader calls beside its threshold.
    Beside(&'static str),
    /// No shader computes it, for this reason.
    Impossible(&'static str),
}

/// Why a plan has no shader text.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoShader {
    /// No shader computes what a stage does.
    #[error("{says}: {reason}")]
    Impossible {
        /// What the stage does.
        says: String,
        /// Why no shader does.
        reason: &'static str,
    },
    /// The pipeline of thresholds cannot be written as text.
    #[error(transparent)]
    Assemble(#[from] AssembleError),
}

/// Where a stage of shading stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Phase {
    /// Changes alphas, or gives thresholds.
    Alpha,
    /// Makes the thresholds.
    Threshold,
    /// Changes the thresholds of all samples.
    Correct,
    /// Compares.
    Test,
    /// Traces rays from what is kept.
    Trace,
    /// Makes colours of what is kept.
    Resolve,
    /// Draws over them.
    Blend,
}

type Shade = Arc<dyn Fn(&Shading<'_>, &mut Work, &mut TileResult) + Send + Sync>;
type After = Arc<dyn Fn(&mut Frame, &Moment, &mut Memory) + Send + Sync>;

/// When a picture was seen, for stages after shading.
#[derive(Clone, Copy, Debug)]
pub struct Moment {
    /// The camera of the frame.
    pub now: Camera,
    /// That of the frame before.
    pub before: Camera,
    /// How far the image is moved within a pixel, to the right and down, in pixels.
    pub offset: DVec2,
}

/// What a stage after shading keeps from frame to frame.
pub type Memory = VecDeque<Picture>;

/// What one take does.
#[derive(Clone)]
pub struct Plan {
    /// The name of the take.
    pub name: String,
    /// How frames are set up.
    pub setup: Setup,
    /// The stages that made it so.
    before: Vec<Told>,
    shade: Vec<(Phase, Told, Shade)>,
    after: Vec<(Told, After)>,
    /// The effect whose stages are added.
    effect: Option<&'static str>,
}

impl core::fmt::Debug for Plan {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let told: Vec<&Told> = self.told().collect();
        f.debug_struct("Plan")
            .field("name", &self.name)
            .field("setup", &self.setup)
            .field("told", &told)
            .finish()
    }
}

impl Plan {
    /// Makes a plan without stages.
    pub(in crate::render) fn new(name: String) -> Self {
        let (before, shade, after) = (Vec::new(), Vec::new(), Vec::new());
        Self { name, setup: Setup::default(), before, shade, after, effect: None }
    }

    /// Says which effect the stages that follow simulate.
    pub(in crate::render) fn simulate(&mut self, effect: Option<&'static str>) {
        self.effect = effect;
    }

    /// Adds a stage before shading, which changes the set-up.
    pub fn before(&mut self, told: Told, set: impl FnOnce(&mut Setup)) {
        self.before.push(Told { effect: self.effect, ..told });
        set(&mut self.setup);
    }

    /// Adds a stage of shading, which changes the columns of a tile; behind those that are in the same phase already.
    pub(in crate::render) fn shade(
        &mut self,
        phase: Phase,
        told: Told,
        run: impl Fn(&Shading<'_>, &mut Work, &mut TileResult) + Send + Sync + 'static,
    ) {
        let at = self.shade.partition_point(|(other, ..)| *other <= phase);
        self.shade.insert(at, (phase, Told { effect: self.effect, ..told }, Arc::new(run)));
    }

    /// Adds a stage after shading, which changes whole pictures.
    pub fn after(
        &mut self,
        told: Told,
        run: impl Fn(&mut Frame, &Moment, &mut Memory) + Send + Sync + 'static,
    ) {
        self.after.push((Told { effect: self.effect, ..told }, Arc::new(run)));
    }

    /// Returns what every stage tells of itself, in the order in which they act.
    pub fn told(&self) -> impl Iterator<Item = &Told> {
        let shade = self.shade.iter().map(|(_, told, _)| told);
        self.before.iter().chain(shade).chain(self.after.iter().map(|(told, _)| told))
    }

    /// Returns what the stages cost in one frame. Frames and thresholds of the census are those of the plan.
    #[must_use]
    pub fn cost_of_frame(&self, census: Census) -> Cost {
        let samples = self.setup.pipeline.map_or(1, |pipeline| u64::from(pipeline.samples().get()));
        let census = Census { frames: 1, thresholds: samples * census.fragments, ..census };
        Cost::frames(1) + self.told().map(|told| census.cost(&told.price)).sum()
    }

    /// Runs the stages of shading on a tile whose alphas were read, and counts what they cost and what went before them.
    pub(in crate::render) fn shade_tile(
        &self,
        shading: &Shading<'_>,
        work: &mut Work,
        result: &mut TileResult,
    ) {
        work.kept.clear();
        self.shade.iter().for_each(|(_, _, run)| run(shading, work, result));
        let census = Census {
            frames: 0,
            fragments: work.fragments.len() as u64,
            texels: work.texels,
            thresholds: work.threshold.len() as u64,
            pixels: 0,
            shown: result.rays.iter().map(|[rays, _]| u64::from(*rays)).sum(),
        };
        let shade = self.shade.iter().map(|(_, told, _)| told);
        result.cost = self.before.iter().chain(shade).map(|told| census.cost(&told.price)).sum();
    }

    /// Returns what a frame costs beside its tiles.
    pub(in crate::render) fn cost_beside_tiles(&self) -> Cost {
        let shade = self.shade.iter().map(|(_, told, _)| told);
        let census = Census { frames: 1, ..Census::default() };
        Cost::frames(1) + self.before.iter().chain(shade).map(|told| census.cost(&told.price)).sum()
    }

    /// Runs the stages after shading on a frame; `memories` has what each of them keeps from the frames before.
    pub fn finish(&self, frame: &mut Frame, moment: &Moment, memories: &mut Vec<Memory>) {
        memories.resize(self.after.len(), Memory::new());
        for ((told, run), memory) in self.after.iter().zip(memories) {
            run(frame, moment, memory);
            let census = Census { pixels: frame.picture.coverage.len() as u64, ..Census::default() };
            frame.cost += census.cost(&told.price);
        }
    }

    /// Returns whether frames are mixed with those before.
    #[must_use]
    pub fn mixes(&self) -> bool {
        self.setup.mixes
    }

    /// Returns the same without what follows the test, if rays follow it: what they start from.
    #[must_use]
    pub fn before_rays(&self) -> Option<Self> {
        let shade = self.shade.iter().filter(|(phase, ..)| *phase != Phase::Trace).cloned().collect();
        let setup = Setup { rays: false, ..self.setup.clone() };
        self.setup.rays.then(|| Self { setup, shade, after: Vec::new(), ..self.clone() })
    }

    /// Returns the threshold of the plan as WGSL, made of the chunks of its stages only, and after it the functions that the
    /// stages call beside it. After a listing to the letter, and after fresh random numbers, all is to the letter.
    ///
    /// # Errors
    ///
    /// [`NoShader`] where no shader computes the threshold, as for what hardware does by itself, and for numbers that cannot
    /// be written as text.
    pub fn shader(&self) -> Result<String, NoShader> {
        let mut beside = String::new();
        for told in self.told() {
            match told.text {
                Text::None => {}
                Text::Beside(chunk) => beside += chunk,
                Text::Impossible(reason) => {
                    return Err(NoShader::Impossible { says: told.says.clone(), reason });
                }
            }
        }
        // What blends without a test says above that it has no threshold.
        let mut pipeline = self.setup.pipeline.unwrap_or_default();
        match pipeline.source {
            Source::Hash(Model::Hashed(hashed) | Model::BeforeCdf(hashed)) => pipeline.form = hashed.form,
            Source::Stochastic => pipeline.form = CdfForm::Literal,
            Source::Hash(Model::Robust(_)) | Source::Fixed(_) | Source::Given => {}
            Source::ScreenDoor(_) | Source::Stipple { .. } => {}
        }
        Ok(assemble(pipeline)? + &beside)
    }
}

/// What a stage tells of itself; the plan adds the effect.
#[must_use]
pub fn tell(says: impl Into<String>, price: &[(Per, Cost)], text: Text) -> Told {
    Told { effect: None, says: says.into(), price: price.to_vec(), text }
}
