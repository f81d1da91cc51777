//! Carries a plan out: one frame, tile by tile, stage by stage over the columns of a tile, and counts what it does.

use super::plan::{Moment, Plan};
use super::rasterise::{Screen, TILE};
use super::rays::Occluders;
use super::shot::Shot;
use super::texture::Texture;
use super::work::{Frame, PIXELS, Shading, TileResult, Work};
use crate::render::draw::cost::Cost;
use crate::render::measure::depth::Depth;
use crate::render::measure::layers::{LayerSums, layer_sums};
use crate::render::measure::picture::{Picture, SKY};
use crate::render::scene_file::load::Scene;
use rand::SeedableRng;
use rand::rngs::Xoshiro256PlusPlus;
use rayon::prelude::*;

/// Draws a frame of a shot up to the end of shading, at every place of each pixel; [`Plan::finish`] makes the image of it. The
/// bits do not depend on the number of threads.
#[must_use]
pub fn frame(scene: &Scene, textures: &[Texture], plan: &Plan, shot: &Shot, index: u32) -> Frame {
    let setup = &plan.setup;
    let camera = shot.camera(scene, index, setup.places);
    let screen =
        Screen::new(&scene.mesh, &camera, f64::from(index), setup.offset(index), setup.space, setup.needs);
    let occluders = setup.rays.then(|| Occluders::new(&scene.mesh, f64::from(index)));
    let parts = if setup.needs.coverage { scene.parts() } else { &[] };
    let keeps_depth = scene.file.depth.is_some() || setup.needs.depth;
    let tile = |work: &mut Work, tile: usize| {
        let length = |asked: bool| if asked { PIXELS } else { 0 };
        let mut result = TileResult {
            colour: vec![SKY; PIXELS],
            coverage: vec![0.0; PIXELS],
            touched: vec![false; PIXELS],
            cost: Cost::default(),
            layers: LayerSums::default(),
            rays: vec![[0; 2]; length(setup.rays)],
            depth: vec![f32::INFINITY; length(keeps_depth)],
        };
        let shading = Shading {
            mesh: &scene.mesh,
            parts,
            textures,
            setup,
            screen: &screen,
            camera: &camera,
            frame: index,
            occluders: occluders.as_ref(),
            tile,
        };
        // The numbers of a tile are its own, so that the order in which tiles are drawn does not matter.
        let seed = scene.file.seed ^ (u64::from(index) << 32) ^ ((tile as u64) << 8);
        work.rng = Xoshiro256PlusPlus::seed_from_u64(seed);
        shading.sample(work);
        if work.fragments.is_empty() {
            return result;
        }
        work.fragments.pixel.iter().for_each(|&pixel| result.touched[usize::from(pixel)] = true);
        plan.shade_tile(&shading, work, &mut result);
        if scene.file.layers.is_some() && !work.kept.is_empty() {
            result.layers = layer_sums(&work.fragments, &work.tested, &work.kept, setup.samples);
        }
        result
    };
    let tiles: Vec<TileResult> = (0..screen.tiles()).into_par_iter().map_init(Work::default, tile).collect();
    let pixels = camera.resolution.map(|side| side as usize).iter().product();
    let mut frame = Frame {
        picture: Picture::sky(camera.resolution),
        touched: vec![false; pixels],
        cost: plan.cost_beside_tiles(),
        layers: LayerSums::default(),
        rays: vec![[0; 2]; if setup.rays { pixels } else { 0 }],
        depth: keeps_depth.then(|| Depth { size: camera.resolution, values: vec![f32::INFINITY; pixels] }),
    };
    for (tile, result) in tiles.iter().enumerate() {
        frame.cost += result.cost;
        frame.layers.covariance += result.layers.covariance;
        frame.layers.deviation += result.layers.deviation;
        let ([left, top], [width, height]) = screen.tile(tile);
        for y in 0..height {
            let (from, to) = ((y * TILE) as usize, ((top + y) * camera.resolution[0] + left) as usize);
            let row = |start: usize| start..start + width as usize;
            frame.picture.colour[row(to)].copy_from_slice(&result.colour[row(from)]);
            frame.picture.coverage[row(to)].copy_from_slice(&result.coverage[row(from)]);
            frame.touched[row(to)].copy_from_slice(&result.touched[row(from)]);
            if setup.rays {
                frame.rays[row(to)].copy_from_slice(&result.rays[row(from)]);
            }
            if let Some(depth) = &mut frame.depth {
                depth.values[row(to)].copy_from_slice(&result.depth[row(from)]);
            }
        }
    }
    frame
}

/// When a frame of a shot is seen, for the stages after shading.
#[must_use]
pub fn moment(scene: &Scene, plan: &Plan, shot: &Shot, index: u32) -> Moment {
    Moment {
        now: shot.camera(scene, index, 1),
        before: shot.camera(scene, index.saturating_sub(1), 1),
        offset: plan.setup.offset(index) / f64::from(plan.setup.places),
    }
}
