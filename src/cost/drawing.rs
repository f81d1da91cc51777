//! Time of a frame against triangles and pixels: a meadow of alpha-tested cards under two techniques, without rays and with one
//! a pixel.

use super::Effort;
use super::clock::{Time, turns};
use crate::render::draw::cost::Cost;
use crate::render::draw::frame::frame;
use crate::render::draw::plan::Plan;
use crate::render::draw::shot::shots;
use crate::render::draw::texture::Texture;
use crate::render::effect::plan::plan;
use crate::render::scene_file::load::{Scene, prepare};
use crate::render::scene_file::read;
use crate::render::scene_file::schema::{SceneFile, Takes};
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

/// The scene that is drawn, as a scene file: 40 000 cards on 1920 x 1080 pixels.
pub const GRASS: &str = include_str!("grass.toml");

/// What one take of a size costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// Triangles of the scene.
    pub triangles: usize,
    /// Width and height of the image in pixels.
    pub resolution: [u32; 2],
    /// The take.
    pub take: String,
    /// Fragments of the frame.
    pub fragments: u64,
    /// Rays of the frame.
    pub rays: u64,
    /// Milliseconds a frame.
    pub time: Time,
}

/// The numbers of cards and the resolutions that are measured, the whole scene last.
const SIZES: [(u32, [u32; 2]); 5] = [
    (400, [1920, 1080]),
    (4_000, [1920, 1080]),
    (40_000, [480, 270]),
    (40_000, [960, 540]),
    (40_000, [1920, 1080]),
];

/// How many times smaller all of it is where little is measured: cards, and pixels along each side.
const QUICK: u32 = 40;

/// How many steps [`drawings`] reports.
#[must_use]
pub fn steps(effort: Effort) -> u64 {
    SIZES.len() as u64 * rounds(effort)
}

const fn rounds(effort: Effort) -> u64 {
    effort.pick(1, 5)
}

/// Measures every take at every size, on all threads, the takes of a size in turns; `done` is called after each round. Nothing
/// where the scene cannot be read, which a test excludes.
#[must_use]
pub fn drawings(effort: Effort, done: &dyn Fn()) -> Vec<Drawing> {
    let smaller = effort.pick(QUICK, 1);
    let scenes =
        SIZES.iter().filter_map(|&(cards, size)| grass(cards / smaller, size.map(|side| side / smaller)));
    scenes.flat_map(|scene| of_scene(&scene, effort, done)).collect()
}

/// The meadow with so many cards, on so many pixels.
#[must_use]
pub fn grass(cards: u32, resolution: [u32; 2]) -> Option<Scene> {
    let mut file = read::read(GRASS, "grass.toml").ok()?;
    file.surface.iter_mut().filter_map(|surface| surface.instances.as_mut()).for_each(|of| of.count = cards);
    prepare(SceneFile { resolution, ..file }, Path::new("")).ok()
}

fn of_scene(scene: &Scene, effort: Effort, done: &dyn Fn()) -> Vec<Drawing> {
    let (Some(shot), Takes::Sets(sets)) = (shots(scene).first().copied(), &scene.file.effects) else {
        return Vec::new();
    };
    let plans: Vec<Plan> = sets.iter().map(plan).collect();
    let textures: Vec<Vec<Texture>> = plans.iter().map(|plan| scene.textures(&plan.setup.textures)).collect();
    let mut costs = vec![Cost::default(); plans.len()];
    let draw = |take: usize, _| {
        let begun = Instant::now();
        let drawn = black_box(frame(scene, &textures[take], &plans[take], &shot, 0));
        let milliseconds = begun.elapsed().as_secs_f64() * 1e3;
        costs[take] = drawn.cost;
        milliseconds
    };
    let times = turns(plans.len(), rounds(effort) as usize, draw, done);
    let takes = plans.into_iter().zip(costs).zip(times);
    let row = |((plan, cost), time): ((Plan, Cost), Time)| Drawing {
        triangles: scene.mesh.triangles.len(),
        resolution: scene.file.resolution,
        take: plan.name,
        fragments: cost.fragments,
        rays: cost.rays,
        time,
    };
    takes.map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_take_is_measured_at_every_size() {
        let found = drawings(Effort::Quick, &|| ());
        assert_eq!(found.len(), 4 * SIZES.len());
        let [cards, most] = [SIZES[0].0, SIZES[4].0].map(|cards| (2 * cards / QUICK) as usize);
        assert_eq!([found[0].triangles, found[19].triangles], [cards, most]);
        assert!(found.iter().all(|row| row.fragments > 0 && row.time.min <= row.time.median));
        assert!(found.iter().all(|row| (row.rays > 0) == row.take.contains("ray")));
    }
}
