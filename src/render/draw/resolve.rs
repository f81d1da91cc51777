//! From fragments to the colours and the coverage of pixels: the nearest that is kept, or a blend of all.

use super::work::{NONE, PIXELS, Shading, TileResult, Work};
use crate::render::measure::picture::{LEAF, SKY};
use crate::technique::premultiplied;
use crate::technique::prior_work::test_then_blend::Layer;

impl Shading<'_> {
    /// Draws what is nearest of the fragments that are kept, at each sample.
    pub(in crate::render) fn resolve(&self, work: &Work, result: &mut TileResult) {
        let samples = self.setup.samples.get() as usize;
        let mut nearest = vec![NONE; PIXELS * samples];
        for (at, &kept) in work.kept.iter().enumerate() {
            let pixel = usize::from(work.fragments.pixel[at]);
            let depth = work.fragments.depth[at];
            for sample in (0..samples).filter(|sample| kept >> sample & 1 == 1) {
                let held = &mut nearest[pixel * samples + sample];
                if *held == NONE || depth < work.fragments.depth[*held as usize] {
                    *held = at as u32;
                }
            }
        }
        for (depth, held) in result.depth.iter_mut().zip(nearest.chunks_exact(samples)) {
            *depth = work.fragments.depth.get(held[0] as usize).copied().unwrap_or(f32::INFINITY);
        }
        let share = 1.0 / samples as f32;
        for (pixel, held) in nearest.chunks_exact(samples).enumerate() {
            let covered = held.iter().filter(|&&at| at != NONE).count();
            if covered == 0 {
                continue;
            }
            // Surfaces have the light that their ray finds, all of it without one.
            let light = result.rays.get(pixel).map_or(1.0, |[_, open]| f32::from(*open));
            let mut colour = SKY.map(|c| c * (samples - covered) as f32);
            let mut last = (NONE, [0.0; 3]);
            for &at in held.iter().filter(|&&at| at != NONE) {
                if at != last.0 {
                    last = (at, self.colour(work, at as usize));
                }
                colour = [0, 1, 2].map(|c| colour[c] + light * last.1[c]);
            }
            result.colour[pixel] = colour.map(|sum| sum * share);
            result.coverage[pixel] = covered as f32 * share;
        }
    }

    /// Draws pixels as `drawn` makes them of their fragments, in the order in which they come, and the background.
    pub(in crate::render) fn blend(
        &self,
        work: &Work,
        drawn: impl Fn(&[Layer], f64) -> f64,
        result: &mut TileResult,
    ) {
        let mut of_pixel: Vec<Vec<usize>> = vec![Vec::new(); PIXELS];
        for at in 0..work.fragments.len() {
            of_pixel[usize::from(work.fragments.pixel[at])].push(at);
        }
        for (pixel, fragments) in of_pixel.iter().enumerate().filter(|(_, fragments)| !fragments.is_empty()) {
            let layers = |value: &dyn Fn(usize) -> f32| -> Vec<Layer> {
                let layer = |&at: &usize| Layer {
                    depth: f64::from(work.fragments.depth[at]),
                    alpha: f64::from(work.alpha[at]),
                    value: f64::from(value(at)),
                };
                fragments.iter().map(layer).collect()
            };
            let drawn =
                |value: &dyn Fn(usize) -> f32, behind: f32| drawn(&layers(value), f64::from(behind)) as f32;
            result.colour[pixel] = [0, 1, 2].map(|c| drawn(&|at| self.colour(work, at)[c], SKY[c]));
            result.coverage[pixel] = drawn(&|_| 1.0, 0.0);
        }
    }

    fn colour(&self, work: &Work, at: usize) -> [f32; 3] {
        let triangle = work.fragments.triangle[at];
        let texture = self.texture(triangle);
        let shade = self.screen.shade(triangle);
        let colour = match texture.colour(&work.access[at]) {
            Some([r, g, b]) if self.setup.textures.premultiplied => {
                premultiplied::divide([r, g, b, work.alpha[at]].map(f64::from)).map(|c| c as f32)
            }
            Some(colour) => colour,
            None => LEAF,
        };
        let tint = work.fragments.tint(at);
        [0, 1, 2].map(|c| (colour[c] * tint[c] * shade).min(1.0))
    }
}
