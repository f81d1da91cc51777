//! Carries a plan out: one frame, tile by tile, stage by stage over the columns of a tile, and counts what it does.

use super::cost::Cost;
use super::fragments::Fragments;
use super::plan::Plan;
use super::rasterise::{Screen, TILE};
use super::rays::{self, Occluders};
use super::shot::Shot;
use super::sub_pixel;
use super::texture::Texture;
use super::work::{Draw, Frame, NONE, PIXELS, TileResult, Work};
use crate::render::effect::stage::{Stage, hashes};
use crate::render::effect::tables::{Apart, Door, FadeIn, Occlusion, Pattern};
use crate::render::measure::depth::Depth;
use crate::render::measure::layers::{LayerSums, layer_sums};
use crate::render::measure::picture::{Picture, SKY};
use crate::render::scene_file::load::Scene;
use crate::technique::prior_work::test_then_blend::{naive, test_then_blend};
use crate::threshold::batch::{Batch, Model};
use crate::threshold::fixed::{FIXED_THRESHOLD, passes};
use crate::threshold::footprint::Footprint;
use crate::threshold::hash::{Hash, HashKind, open_lattice, pcg4d::pcg4d};
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::robust::Robust;
use crate::threshold::stage::clamp::clamp_last;
use crate::threshold::stage::coverage::{
    decorrelated, hardware_threshold, jittered, pixel_value, regular, shuffled, turned,
};
use crate::threshold::stage::fade_in::{anisotropy, blend, fade_in};
use crate::threshold::stage::independent::{ByFrame, by_offset};
use crate::threshold::stage::order::Order;
use crate::threshold::stage::screen_door;
use crate::threshold::stage::stipple::{self, Density};
use crate::threshold::stochastic::stochastic;
use core::num::NonZeroU32;
use glam::DVec2;
use rand::rngs::Xoshiro256PlusPlus;
use rand::{Rng, SeedableRng};
use rayon::prelude::*;

/// Which of the 16! masks a random screen door has.
pub(in crate::render) const DOOR_SEED: u32 = 0;

/// Draws a frame of a shot. The bits do not depend on the number of threads.
#[must_use]
pub fn frame(scene: &Scene, textures: &[Texture], plan: &Plan, shot: &Shot, index: u32) -> Frame {
    let camera = shot.camera(scene, index, plan.places);
    let screen =
        Screen::new(&scene.mesh, &camera, f64::from(index), plan.offset(index), plan.space, plan.needs);
    let is_ray = |stage: &Stage| matches!(stage, Stage::Occlude(_));
    let occluders = plan.stages.iter().any(is_ray).then(|| Occluders::new(&scene.mesh, f64::from(index)));
    let draw = Draw { scene, textures, plan, screen: &screen, frame: index, camera: &camera, occluders };
    let tiles: Vec<TileResult> = (0..screen.tiles())
        .into_par_iter()
        .map_init(Work::default, |work, tile| draw.tile(work, tile))
        .collect();
    let mut picture = Picture::sky(camera.resolution);
    let mut touched = vec![false; picture.coverage.len()];
    let passes = plan.stages.iter().filter(|stage| matches!(stage, Stage::Rasterise(_))).count() as u64;
    let mut cost = Cost { frames: 1, passes, ..Cost::default() };
    let mut layers = LayerSums::default();
    let mut rays = vec![[0; 2]; if draw.occluders.is_some() { touched.len() } else { 0 }];
    let mut depth = draw
        .keeps_depth()
        .then(|| Depth { size: camera.resolution, values: vec![f32::INFINITY; touched.len()] });
    for (tile, result) in tiles.iter().enumerate() {
        cost += result.cost;
        layers.covariance += result.layers.covariance;
        layers.deviation += result.layers.deviation;
        let ([left, top], [width, height]) = screen.tile(tile);
        for y in 0..height {
            let (from, to) = ((y * TILE) as usize, ((top + y) * picture.size[0] + left) as usize);
            let row = |start: usize| start..start + width as usize;
            picture.colour[row(to)].copy_from_slice(&result.colour[row(from)]);
            picture.coverage[row(to)].copy_from_slice(&result.coverage[row(from)]);
            touched[row(to)].copy_from_slice(&result.touched[row(from)]);
            if !rays.is_empty() {
                rays[row(to)].copy_from_slice(&result.rays[row(from)]);
            }
            if let Some(depth) = &mut depth {
                depth.values[row(to)].copy_from_slice(&result.depth[row(from)]);
            }
        }
    }
    for stage in &plan.stages {
        if let Stage::Downsample(side) = stage {
            picture = picture.downsample(*side);
            let across = camera.resolution[0] / side;
            touched = (0..picture.coverage.len() as u32)
                .map(|at| touched[((at / across * camera.resolution[0] + at % across) * side) as usize])
                .collect();
            if !rays.is_empty() {
                let mut sums = vec![[0; 2]; touched.len()];
                for (at, of_place) in (0_u32..).zip(&rays) {
                    let [x, y] = [at % camera.resolution[0], at / camera.resolution[0]].map(|p| p / side);
                    let sum = &mut sums[(y * across + x) as usize];
                    *sum = [sum[0] + of_place[0], sum[1] + of_place[1]];
                }
                rays = sums;
            }
        }
    }
    Frame { picture, touched, cost, layers, rays, depth }
}

impl Draw<'_> {
    fn keeps_depth(&self) -> bool {
        self.scene.file.depth.is_some() || self.plan.needs.depth
    }

    pub(in crate::render) fn texture(&self, triangle: u32) -> &Texture {
        &self.textures[self.scene.mesh.triangles[triangle as usize].texture as usize]
    }

    fn tile(&self, work: &mut Work, tile: usize) -> TileResult {
        let mut result = TileResult {
            colour: vec![SKY; PIXELS],
            coverage: vec![0.0; PIXELS],
            touched: vec![false; PIXELS],
            cost: Cost::default(),
            layers: LayerSums::default(),
            rays: Vec::new(),
            depth: if self.keeps_depth() { vec![f32::INFINITY; PIXELS] } else { Vec::new() },
        };
        if self.occluders.is_some() {
            result.rays = vec![[0; 2]; PIXELS];
        }
        // The numbers of a tile are its own, so that the order in which tiles are drawn does not matter.
        let seed = self.scene.file.seed ^ (u64::from(self.frame) << 32) ^ ((tile as u64) << 8);
        let mut rng = Xoshiro256PlusPlus::seed_from_u64(seed);
        for stage in &self.plan.stages {
            match stage {
                Stage::Rasterise(_) => {
                    self.screen.fragments(tile, &mut work.fragments);
                    result.cost.fragments += work.fragments.len() as u64;
                    for &pixel in &work.fragments.pixel {
                        result.touched[usize::from(pixel)] = true;
                    }
                    if work.fragments.is_empty() {
                        return result;
                    }
                }
                Stage::SampleAlpha(_) => self.sample(work, tile, &mut result.cost),
                Stage::Fixed(threshold) => {
                    work.threshold.clear();
                    work.threshold.resize(work.fragments.len(), *threshold);
                }
                Stage::Stochastic => {
                    work.threshold.clear();
                    let draws = (0..work.fragments.len()).map(|_| stochastic::<f32>(rng.next_u32()));
                    work.threshold.extend(draws);
                    result.cost.randoms += work.fragments.len() as u64;
                }
                Stage::ScreenDoor(door) => {
                    self.screen_door(work, tile, *door);
                    if *door == Door::Hashed {
                        result.cost.hashes += 3 * work.threshold.len() as u64;
                    }
                }
                Stage::Stipple(density) => self.stipple(work, tile, *density),
                Stage::LevelThreshold => {
                    work.threshold.clear();
                    let triangles = work.fragments.triangle.iter().zip(&work.access);
                    work.threshold
                        .extend(triangles.map(|(&t, access)| self.texture(t).level_threshold(access)));
                }
                Stage::Hash(model, _) => {
                    self.hash(work, model);
                    result.cost.hashes += work.threshold.len() as u64 * hashes(model);
                }
                Stage::Stratify(frames, order) => self.stratify(work, *frames, *order),
                Stage::Coverage(samples, pattern) => {
                    self.cover(work, tile, *samples, *pattern, &mut rng, &mut result.cost);
                }
                Stage::FadeIn(table) => self.fade(work, table),
                Stage::Correct => {
                    let samples = self.plan.samples as usize;
                    sub_pixel::correct(&work.fragments, self.scene.parts(), samples, &mut work.threshold);
                }
                Stage::Clamp => work.threshold.iter_mut().for_each(|t| *t = clamp_last(*t)),
                Stage::Test => {
                    test(work, self.plan.samples);
                    result.cost.tests += work.threshold.len() as u64;
                }
                Stage::Occlude(table) => self.occlude(work, tile, table, &mut rng, &mut result),
                Stage::Resolve { divide } => self.resolve(work, *divide, &mut result),
                Stage::Blend(threshold) => {
                    let threshold = f64::from(*threshold);
                    self.blend(
                        work,
                        |layers, behind| test_then_blend(layers, behind, threshold),
                        &mut result,
                    );
                    result.cost.blends += work.fragments.len() as u64;
                }
                Stage::BlendAll => {
                    self.blend(work, naive, &mut result);
                    result.cost.blends += work.fragments.len() as u64;
                }
                // The first is done beforehand, the second by the hash, the third and the fourth when fragments are made, the
                // fifth when texels are read, the others on whole pictures.
                Stage::Scaled(_) | Stage::Independent(..) => {}
                Stage::Touch | Stage::Multisample(_) | Stage::Foveate(_) => {}
                Stage::Downsample(_) | Stage::History(_) | Stage::Average(_) => {}
            }
        }
        if self.scene.file.layers.is_some() && !work.kept.is_empty() {
            result.layers = layer_sums(work, self.plan.samples);
        }
        result
    }

    fn sample(&self, work: &mut Work, tile: usize, cost: &mut Cost) {
        let (corner, _) = self.screen.tile(tile);
        work.access.clear();
        work.alpha.clear();
        for at in 0..work.fragments.len() {
            let texture = self.texture(work.fragments.triangle[at]);
            let access = self.plan.access(texture, &work.fragments, corner, at);
            work.alpha.push(texture.alpha(&access, &mut cost.texels));
            work.access.push(access);
        }
    }

    fn hash(&self, work: &mut Work, model: &Model) {
        let columns = work.fragments.footprint.columns();
        work.threshold.clear();
        work.threshold.resize(work.fragments.len(), 0.0);
        let frames = self.plan.stages.iter().find_map(|stage| match stage {
            Stage::Independent(frames, apart) => Some((*frames, *apart)),
            _ => None,
        });
        let Some((frames, apart)) = frames else {
            Batch::new(*model).thresholds(&columns, &mut work.threshold);
            return;
        };
        // Batches know the hashes of the catalogue only.
        let frame = self.frame % frames;
        for (at, threshold) in work.threshold.iter_mut().enumerate() {
            let footprint = columns.footprint(at);
            *threshold = match apart {
                Apart::Offset => with_hash(model, &footprint, |hash| by_offset(hash, frame)),
                Apart::Word => with_hash(model, &footprint, |hash| ByFrame { hash, frame }),
            };
        }
    }

    fn stratify(&self, work: &mut Work, frames: NonZeroU32, order: Order) {
        work.threshold.iter_mut().for_each(|chi| *chi = order.threshold(*chi, self.frame, frames));
    }

    fn cover(
        &self,
        work: &mut Work,
        tile: usize,
        samples: NonZeroU32,
        pattern: Pattern,
        rng: &mut Xoshiro256PlusPlus,
        cost: &mut Cost,
    ) {
        let sample = 0..samples.get();
        let source = core::mem::take(&mut work.threshold);
        let out = &mut work.threshold;
        for at in 0..work.fragments.len() {
            // Patterns without noise have no source.
            let chi = source.get(at).copied().unwrap_or(FIXED_THRESHOLD as f32);
            match pattern {
                Pattern::Regular => out.extend(sample.clone().map(|i| regular::<f32>(i, samples))),
                Pattern::Hardware => {
                    out.extend(sample.clone().map(|i| hardware_threshold::<f32>(i, samples)))
                }
                Pattern::Pixel => {
                    let chi = pixel_value::<f32>(self.place(&work.fragments, tile, at));
                    cost.hashes += 1;
                    out.extend(sample.clone().map(|i| turned(chi, i, samples)));
                }
                Pattern::Jittered => out.extend(sample.clone().map(|i| jittered(chi, i, samples))),
                Pattern::Decorrelated => {
                    let [_, first, second, _] = self.words(&work.fragments, tile, at);
                    let xi = [open_lattice::<f32>(first), open_lattice(second)];
                    cost.hashes += 1;
                    out.extend(sample.clone().map(|i| jittered(chi, decorrelated(xi, i, samples), samples)));
                }
                Pattern::Random => {
                    let [_, _, _, word] = self.words(&work.fragments, tile, at);
                    cost.hashes += 1;
                    out.extend(sample.clone().map(|i| jittered(chi, shuffled(word, i, samples), samples)));
                }
                Pattern::Independent => {
                    out.push(chi);
                    out.extend((1..sample.end).map(|_| stochastic::<f32>(rng.next_u32())));
                    cost.randoms += u64::from(sample.end - 1);
                }
            }
        }
    }

    fn screen_door(&self, work: &mut Work, tile: usize, door: Door) {
        const SIDE: u32 = screen_door::TILE;
        // One mask for the whole screen.
        let mask: Vec<f32> =
            (0..SIDE * SIDE).map(|i| screen_door::random_mask([i % SIDE, i / SIDE], DOOR_SEED)).collect();
        work.threshold.clear();
        work.threshold.extend((0..work.fragments.len()).map(|at| {
            let [x, y] = self.place(&work.fragments, tile, at);
            match door {
                Door::Fixed => screen_door::fixed([x, y]),
                Door::Random => mask[(y % SIDE * SIDE + x % SIDE) as usize],
                Door::Hashed => screen_door::randomised([x, y], u32::from(work.fragments.layer[at])),
            }
        }));
    }

    fn stipple(&self, work: &mut Work, tile: usize, density: Density) {
        for (at, threshold) in work.threshold.iter_mut().enumerate() {
            *threshold = stipple::threshold(density, self.place(&work.fragments, tile, at), *threshold);
        }
    }

    /// The pixel of a fragment: its column and row.
    fn place(&self, fragments: &Fragments, tile: usize, at: usize) -> [u32; 2] {
        let ([left, top], _) = self.screen.tile(tile);
        let pixel = u32::from(fragments.pixel[at]);
        [left + pixel % TILE, top + pixel / TILE]
    }

    /// Four words that belong to one fragment, and to its frame among those that thresholds repeat after: the twin of the
    /// shader's `fragment_words`.
    fn words(&self, fragments: &Fragments, tile: usize, at: usize) -> [u32; 4] {
        let [x, y] = self.place(fragments, tile, at);
        let frame = self.plan.cycle().map_or(self.frame, |frames| (u64::from(self.frame) % frames) as u32);
        pcg4d([x, y, frame, u32::from(fragments.layer[at])])
    }

    fn fade(&self, work: &mut Work, table: &FadeIn) {
        let samples = work.threshold.len() / work.fragments.len();
        for at in 0..work.fragments.len() {
            let mut lod = work.access[at].lod;
            if table.anisotropy {
                let [width, height] = self.texture(work.fragments.triangle[at]).levels[0].size;
                let texels = glam::vec2(width as f32, height as f32);
                let along = [work.fragments.dtdx[at], work.fragments.dtdy[at]].map(|d| (d * texels).length());
                lod *= anisotropy(along);
            }
            let share = blend(lod, table.full_noise_lod);
            for threshold in &mut work.threshold[at * samples..(at + 1) * samples] {
                *threshold = fade_in(table.authored, *threshold, share);
            }
        }
    }

    /// Traces the ray of every pixel that shows a surface, from the nearest.
    fn occlude(
        &self,
        work: &Work,
        tile: usize,
        table: &Occlusion,
        rng: &mut Xoshiro256PlusPlus,
        result: &mut TileResult,
    ) {
        let Some(occluders) = &self.occluders else { return };
        let mut nearest = vec![NONE; PIXELS];
        for at in (0..work.fragments.len()).filter(|&at| work.kept[at] != 0) {
            let held = &mut nearest[usize::from(work.fragments.pixel[at])];
            if *held == NONE || work.fragments.depth[at] < work.fragments.depth[*held as usize] {
                *held = at as u32;
            }
        }
        let ([left, top], _) = self.screen.tile(tile);
        let columns = work.fragments.footprint.columns();
        for (pixel, &at) in (0_u32..).zip(&nearest).filter(|(_, at)| **at != NONE) {
            let at = at as usize;
            let corner = [left + pixel % TILE, top + pixel / TILE].map(f64::from);
            let ray = self.camera.ray(DVec2::from(corner) + 0.5 - self.plan.offset(self.frame));
            let point = ray.origin + ray.direction * f64::from(work.fragments.depth[at]);
            let chi = rays::chi(table, &columns.footprint(at), rng);
            let triangle = work.fragments.triangle[at];
            let is_open = occluders.is_open(triangle, point, self.camera.eye, chi, table.reach);
            result.rays[pixel as usize] = [1, u16::from(is_open)];
            result.cost += rays::cost(table, 1);
        }
    }
}

/// The threshold of a model with another hash in place of its own.
fn with_hash<H: Hash<f32>>(model: &Model, footprint: &Footprint<f32>, of: impl Fn(HashKind) -> H) -> f32 {
    match *model {
        Model::Hashed(HashedAlpha { variant, hash, hash_scale, form }) => {
            HashedAlpha { variant, hash: of(hash), hash_scale, form }.threshold(footprint)
        }
        Model::BeforeCdf(HashedAlpha { variant, hash, hash_scale, form }) => {
            HashedAlpha { variant, hash: of(hash), hash_scale, form }.trace(footprint).interpolated
        }
        Model::Robust(Robust { variant, hash, hash_scale, join, repairs }) => {
            let robust = Robust { variant, hash: of(hash), hash_scale, join, repairs };
            robust.threshold(footprint).unwrap_or(f32::NAN)
        }
    }
}

/// Tests each fragment against its thresholds: one a sample, or one for all of them.
fn test(work: &mut Work, samples: u32) {
    work.kept.clear();
    let all = u64::MAX >> (u64::BITS - samples);
    let each = work.threshold.len() / work.fragments.len();
    for (at, (&alpha, thresholds)) in work.alpha.iter().zip(work.threshold.chunks_exact(each)).enumerate() {
        let kept = if let [one] = thresholds {
            if passes(alpha, *one) { all } else { 0 }
        } else {
            thresholds.iter().enumerate().map(|(i, &t)| u64::from(passes(alpha, t)) << i).sum()
        };
        work.kept.push(kept & work.fragments.covered.get(at).unwrap_or(&all));
    }
}
