//! All takes of a scene, frame by frame, with what is measured of them.

use super::auto;
use super::expect::{Checked, check};
use super::metrics::{Asked, Measured, Metrics};
use super::motion::{Along, Motion};
use super::picture::{self, Inset, Picture};
use crate::render::draw::cost::Cost;
use crate::render::draw::frame::{frame, moment};
use crate::render::draw::plan::{Memory, Plan};
use crate::render::draw::reference;
use crate::render::draw::shot::{Shot, shots};
use crate::render::draw::texture::{Texture, TextureNeeds};
use crate::render::draw::view::Cause;
use crate::render::effect::Effects;
use crate::render::effect::plan::plan;
use crate::render::scene_file::load::Scene;
use crate::render::scene_file::schema::Takes;
use glam::DVec2;
use image::RgbImage;
use std::time::Instant;

/// Change of a surface a frame from which on noise that stays on the screen is told.
const SLIDES: f64 = 0.01;

/// What became of one take.
#[derive(Clone, Debug)]
pub struct Take {
    /// What it did.
    pub plan: Plan,
    /// What it counted over all shots.
    pub cost: Cost,
    /// What was measured.
    pub metrics: Metrics,
    /// The index of the frame that is shown: the first, or the last if a take of the scene averages frames.
    pub frame: u32,
    /// That frame of every shot with all motion: of the scene as it is, and from each other distance.
    pub shown: Vec<Picture>,
    /// The frame beside that of the first shot, where there is one.
    pub beside: Option<Picture>,
    /// The smaller depth buffer of the first frame, if the scene asks for it.
    pub depth: Option<RgbImage>,
    /// The first shot, frame by frame.
    pub sequence: Vec<RgbImage>,
    /// Time that its frames took, in seconds.
    pub seconds: f64,
}

/// What became of a scene.
#[derive(Clone, Debug)]
pub struct Study {
    /// Its takes, in the order of the file.
    pub takes: Vec<Take>,
    /// The shown frame of every shot as it should be, if the scene asks for that.
    pub truth: Option<Vec<Picture>>,
    /// What the truth cost.
    pub truth_cost: Cost,
    /// What was expected, and whether it came out.
    pub checked: Vec<Checked>,
    /// What should be known of the numbers, a sentence each with the take.
    pub notes: Vec<String>,
}

/// Returns the effects of every take; where the scene leaves them to the planner, its choice with the reasons.
#[must_use]
pub fn chosen(scene: &Scene, textures: &[Texture]) -> Vec<(Effects, Vec<String>)> {
    match &scene.file.effects {
        Takes::Sets(sets) => sets.iter().map(|effects| (effects.clone(), Vec::new())).collect(),
        Takes::Auto => {
            let choice = auto::choose(scene, textures);
            vec![(choice.effects, choice.reasons)]
        }
    }
}

/// Draws everything. `progress` is told after every picture how many are done and how many there are.
#[must_use]
pub fn study(scene: &Scene, progress: &mut dyn FnMut(u64, u64)) -> Study {
    let plans: Vec<Plan> = match &scene.file.effects {
        Takes::Sets(sets) => sets.iter().map(plan).collect(),
        Takes::Auto => vec![plan(&auto::choose(scene, &scene.textures(&TextureNeeds::default())).effects)],
    };
    // One set of textures for all plans that need the same of them.
    let of_reference = reference::texture_needs();
    let mut all: Vec<(TextureNeeds, Vec<Texture>)> = Vec::new();
    let asked = plans.iter().map(|plan| &plan.setup.textures);
    for needs in asked.chain(scene.file.truth.as_ref().map(|_| &of_reference)) {
        if !all.iter().any(|(known, _)| known == needs) {
            all.push((needs.clone(), scene.textures(needs)));
        }
    }
    let find = |needs: &TextureNeeds| -> &[Texture] {
        all.iter().find(|(known, _)| known == needs).map_or(&[], |(_, textures)| textures)
    };
    let shots = shots(scene);
    let frames = scene.file.frames.get();
    // What a mixture shows in its first frame is no mixture.
    let shown = if plans.iter().any(|plan| plan.setup.mixes) { frames - 1 } else { 0 };
    let per_frame = plans.len() as u64 + u64::from(scene.file.truth.is_some());
    let total = shots.len() as u64 * u64::from(frames) * per_frame;
    let mut done = 0;
    let mut truths: Option<Vec<Picture>> = scene.file.truth.as_ref().map(|_| Vec::new());
    let mut truth_cost = Cost::default();
    let mut takes: Vec<(Take, Measured)> = plans
        .into_iter()
        .map(|plan| (Take::new(plan, shown), Measured::new(&scene.file.region, scene.file.depth.as_ref())))
        .collect();
    for shot in &shots {
        let mut memories = vec![Vec::new(); takes.len()];
        takes.iter_mut().for_each(|(_, measured)| measured.begin());
        let mut before: Option<Motion> = None;
        for index in 0..frames {
            let now = (frames > 1).then(|| Motion::new(scene, shot, index));
            let truth = scene.file.truth.as_ref().map(|truth| {
                let (picture, cost) =
                    reference::frame(scene, find(&of_reference), shot, index, truth.samples.get());
                truth_cost += cost;
                done += 1;
                progress(done, total);
                picture
            });
            for ((take, measured), memory) in takes.iter_mut().zip(&mut memories) {
                take.draw(
                    scene,
                    find(&take.plan.setup.textures),
                    shot,
                    index,
                    memory,
                    measured,
                    truth.as_ref(),
                    now.as_ref().zip(before.as_ref()),
                );
                done += 1;
                progress(done, total);
            }
            before = now;
            if let (Some(truths), Some(truth), Cause::All) = (&mut truths, truth, shot.cause)
                && index == shown
            {
                truths.push(truth);
            }
        }
        for (take, measured) in &mut takes {
            measured.end(shot, &mut take.metrics);
        }
    }
    let takes: Vec<Take> = takes.into_iter().map(|(take, _)| take).collect();
    let numbers: Vec<(&str, &Metrics)> =
        takes.iter().map(|take| (take.plan.name.as_str(), &take.metrics)).collect();
    let checked = scene.file.expect.iter().map(|expectation| check(expectation, &numbers)).collect();
    let notes = takes.iter().filter_map(Take::locked).collect();
    Study { takes, truth: truths, truth_cost, checked, notes }
}

impl Study {
    /// Returns the picture of the scene: the shown frames of the takes side by side with the truth last, a row for each shot
    /// that differs in distance; enlarged insets; smaller depth buffers; and the differences of the shown frames to those
    /// beside them, inverted.
    #[must_use]
    pub fn sheet(&self, inset: Option<&Inset>) -> RgbImage {
        let truths = self.truth.as_deref().unwrap_or_default();
        let shots = self.takes.iter().map(|take| take.shown.len()).max().unwrap_or(0);
        let images = |shot: usize| -> Vec<RgbImage> {
            let takes = self.takes.iter().map(|take| &take.shown);
            takes.filter_map(|shown| shown.get(shot)).chain(truths.get(shot)).map(Picture::to_rgb).collect()
        };
        let mut rows: Vec<Vec<RgbImage>> = (0..shots).map(images).collect();
        if let (Some(inset), Some(first)) = (inset, rows.first()) {
            let large = first.iter().map(|image| picture::enlarge(image, inset)).collect();
            rows.insert(1, large);
        }
        let depths: Vec<RgbImage> = self.takes.iter().filter_map(|take| take.depth.clone()).collect();
        if !depths.is_empty() {
            rows.push(depths);
        }
        let differences: Vec<RgbImage> = self.takes.iter().filter_map(Take::difference).collect();
        if !differences.is_empty() {
            rows.push(differences);
        }
        picture::sheet(&rows)
    }
}

impl Take {
    fn new(plan: Plan, frame: u32) -> Self {
        Self {
            plan,
            cost: Cost::default(),
            metrics: Metrics::default(),
            frame,
            shown: Vec::new(),
            beside: None,
            depth: None,
            sequence: Vec::new(),
            seconds: 0.0,
        }
    }

    #[allow(clippy::too_many_arguments)]
    fn draw(
        &mut self,
        scene: &Scene,
        textures: &[Texture],
        shot: &Shot,
        index: u32,
        memories: &mut Vec<Memory>,
        measured: &mut Measured,
        truth: Option<&Picture>,
        motion: Option<(&Motion, &Motion)>,
    ) {
        let begun = Instant::now();
        let mut frame = frame(scene, textures, &self.plan, shot, index);
        self.plan.finish(&mut frame, &moment(scene, &self.plan, shot, index), memories);
        self.seconds += begun.elapsed().as_secs_f64();
        self.cost += frame.cost;
        let is_first_shot = measured.is_first_shot();
        if let (None, Some(table), Some(depth)) = (&self.depth, &scene.file.depth, &frame.depth) {
            let ratio = table.ratio.get();
            self.depth = Some(depth.smaller(ratio).picture(ratio));
        }
        if is_first_shot {
            self.sequence.push(frame.picture.to_rgb());
        }
        if index == self.frame && shot.cause == Cause::All {
            self.shown.push(frame.picture.clone());
        } else if index.abs_diff(self.frame) == 1 && is_first_shot {
            self.beside = Some(frame.picture.clone());
        }
        let asked = Asked {
            layers: scene.file.layers.is_some(),
            ghosts: self.plan.setup.mixes,
            gaze: self.plan.setup.gaze,
        };
        let places = f64::from(self.plan.setup.places);
        // What is mixed from moved images stands where none of them is moved.
        let offset = |index: u32| match self.plan.mixes() {
            true => DVec2::ZERO,
            false => self.plan.setup.offset(index) / places,
        };
        let along =
            motion.map(|(now, before)| Along { now, before, jitter: offset(index - 1) - offset(index) });
        measured.add(&frame, truth, along.as_ref(), asked);
    }

    /// Tells that noise stays where it is on the screen while surfaces move. What is averaged over frames changes slowly there, too.
    fn locked(&self) -> Option<String> {
        let [pixel, surface] = ["flips.pixel", "flips.surface"].map(|name| self.metrics.get(name).copied());
        let (name, pixel, surface) = (&self.plan.name, pixel?, surface?);
        (!self.plan.mixes() && surface > SLIDES && pixel < 0.5 * surface).then(|| {
            format!(
                "{name}: its noise stays on the screen while surfaces move: pixels change by {pixel:.3} a frame, points of \
                 surfaces by {surface:.3}"
            )
        })
    }

    /// Returns the inverted difference of the shown frame and the one beside it; `None` for a still.
    #[must_use]
    pub fn difference(&self) -> Option<RgbImage> {
        Some(picture::difference(self.shown.first()?, self.beside.as_ref()?))
    }
}
