//! What each technique adds to a whole frame of the scene that shows it, and Table 1 over the gallery.
//!
//! A row is a technique that an effect names: its take with and without the table of that effect, drawn in turns. Nothing is
//! written by hand: a new technique has a price as soon as its effect names its scene.

use super::Effort;
use crate::render::draw::reference;
use crate::render::draw::shot::shots;
use crate::render::effect::kind::Technique;
use crate::render::effect::plan::check;
use crate::render::effect::{BuiltIn, Effects, Known, techniques as of_effects};
use crate::render::gallery;
use crate::render::gallery::GALLERY;
use crate::render::measure::study::study;
use crate::render::scene_file::load::{Scene, prepare};
use crate::render::scene_file::read;
use crate::render::scene_file::schema::{SceneFile, Takes};
use core::num::NonZeroU32;
use std::path::Path;
use std::time::Instant;

/// What a technique costs.
#[derive(Clone, Copy)]
pub struct TechniquePrice {
    /// The technique.
    pub technique: &'static Technique,
    /// The effect that it is the price of; `None` for the reference image.
    pub effect: Option<&'static Known>,
    /// Nanoseconds a pixel of a frame without its table, or under the plain alpha test where the rest does not stand alone;
    /// the fastest round.
    pub without: f64,
    /// The same with it.
    pub with: f64,
}

/// Whole frames of a scene, in nanoseconds a pixel, the fastest round: what Table 1 has in milliseconds.
#[derive(Clone, Debug, PartialEq)]
pub struct FramePrice {
    /// The scene of the gallery.
    pub scene: &'static str,
    /// Under the traditional, the hashed (Listing 1) and the stochastic test.
    pub tests: [f64; 3],
}

/// Returns the effects of a take of the gallery, with the scene file that it is in; `None` where there is none.
#[must_use]
pub fn take(scene: &str, take: &str) -> Option<(SceneFile, Effects)> {
    let entry = gallery::find(scene)?;
    let file = read::read(entry.text, entry.name).ok()?;
    let Takes::Sets(sets) = &file.effects else { return None };
    let set = sets.iter().find(|set| set.name.as_deref() == Some(take))?.clone();
    Some((file, set))
}

/// Returns a set of effects without one of them; the plain alpha test where something else needs it.
#[must_use]
pub fn without(set: &Effects, effect: &Known) -> Effects {
    let mut rest = set.clone();
    (effect.remove)(&mut rest);
    if check(&rest).is_ok() { rest } else { Effects::default() }
}

/// Returns every technique that the sources name, with the effect that it is the price of; `None` for the reference image.
pub fn all() -> impl Iterator<Item = (Option<&'static Known>, &'static Technique)> {
    of_effects().map(|(known, technique)| (Some(known), technique)).chain([(None, &reference::TECHNIQUE)])
}

/// How many steps [`techniques`] and [`frames`] report together.
#[must_use]
pub fn steps() -> u64 {
    (all().count() + GALLERY.len()) as u64
}

/// Measures every technique; `done` is called after each.
#[must_use]
pub fn techniques(effort: Effort, done: &dyn Fn()) -> Vec<TechniquePrice> {
    let price = |(effect, technique): (Option<&'static Known>, &'static Technique)| {
        let [scene, name] = technique.shown;
        let (file, set) = take(scene, name)?;
        let [with, without] = match effect {
            None => {
                let plain = of_sets(&file, vec![Effects::default()], effort)?;
                [of_reference(&file, effort)?, plain[0]]
            }
            Some(effect) => {
                let rest = without(&set, effect);
                <[f64; 2]>::try_from(of_sets(&file, vec![set, rest], effort)?).ok()?
            }
        };
        done();
        Some(TechniquePrice { technique, effect, without, with })
    };
    all().filter_map(price).collect()
}

/// Measures the three tests on every scene of the gallery; `done` is called after each.
#[must_use]
pub fn frames(effort: Effort, done: &dyn Fn()) -> Vec<FramePrice> {
    let table = |text: &str| toml::from_str::<Effects>(text).ok();
    let price = |entry: &'static BuiltIn| {
        let file = read::read(entry.text, entry.name).ok()?;
        let sets = vec![Effects::default(), table("hashed = {}")?, table("stochastic = {}")?];
        let tests = of_sets(&file, sets, effort)?;
        done();
        Some(FramePrice { scene: entry.name, tests: tests.try_into().ok()? })
    };
    GALLERY.iter().filter_map(price).collect()
}

/// The scene of a file with other takes: one shot of so many frames, nothing measured but time.
fn ready(file: &SceneFile, sets: Vec<Effects>, frames: u32) -> Option<Scene> {
    let file = SceneFile {
        frames: NonZeroU32::new(frames)?,
        effects: Takes::Sets(sets),
        truth: None,
        distance: None,
        layers: None,
        expect: Vec::new(),
        camera: crate::render::draw::view::View { motion: None, ..file.camera.clone() },
        ..file.clone()
    };
    prepare(file, Path::new("")).ok()
}

/// Nanoseconds a pixel of each set, the fastest of some rounds in turns.
fn of_sets(file: &SceneFile, sets: Vec<Effects>, effort: Effort) -> Option<Vec<f64>> {
    let mut fastest = vec![f64::INFINITY; sets.len()];
    let frames = effort.pick(1, 3);
    let scene = ready(file, sets, frames)?;
    for _ in 0..effort.pick(1, 5) {
        for (fastest, take) in fastest.iter_mut().zip(study(&scene, &mut |_, _| ()).takes) {
            *fastest = fastest.min(take.seconds * 1e9 / (pixels(file) * f64::from(frames)));
        }
    }
    Some(fastest)
}

/// Nanoseconds a pixel of the reference image, at one place a pixel.
fn of_reference(file: &SceneFile, effort: Effort) -> Option<f64> {
    let scene = ready(file, vec![Effects::default()], 1)?;
    let textures = scene.textures(&reference::texture_needs());
    let shot = *shots(&scene).first()?;
    let round = |_| {
        let begun = Instant::now();
        let _ = core::hint::black_box(reference::frame(&scene, &textures, &shot, 0, 1));
        begun.elapsed().as_secs_f64() * 1e9 / pixels(file)
    };
    (0..effort.pick(1, 15)).map(round).reduce(f64::min)
}

fn pixels(file: &SceneFile) -> f64 {
    file.resolution.map(f64::from).iter().product()
}
