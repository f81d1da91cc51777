//! The depth buffer of a frame, and what passes after it make of one that is full of holes (Ols 2009).

use core::num::NonZeroU32;
use image::{Rgb, RgbImage};
use serde::Deserialize;

/// Depths that differ by less than this share are of one surface.
const ALIKE: f32 = 0.01;

/// A depth buffer, and a smaller one that is made of it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DepthBuffer {
    /// How many pixels along each side become one of the smaller buffer.
    pub ratio: NonZeroU32,
}

/// Distances along the line of sight, row by row; infinite where nothing is seen.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Depth {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Depths in object units.
    pub values: Vec<f32>,
}

impl Depth {
    /// Returns the buffer that holds the mean depth of each whole square of so many pixels along each side.
    #[must_use]
    pub fn smaller(&self, ratio: u32) -> Self {
        let size = self.size.map(|side| side / ratio);
        let mean = |at: u32| {
            let depths = self.square([at % size[0] * ratio, at / size[0] * ratio], ratio);
            depths.sum::<f32>() / (ratio * ratio) as f32
        };
        Self { size, values: (0..size[0] * size[1]).map(mean).collect() }
    }

    /// Returns the share of the depths of a smaller buffer at which there is nothing, among those of squares that are
    /// covered as a whole: "the wildly different values can produce unexpected results".
    #[must_use]
    pub fn phantoms(&self, ratio: u32) -> f64 {
        let smaller = self.smaller(ratio);
        let (mut phantoms, mut all) = (0_u32, 0_u32);
        for (at, &mean) in (0_u32..).zip(&smaller.values).filter(|(_, mean)| mean.is_finite()) {
            let [x, y] = [at % smaller.size[0], at / smaller.size[0]];
            let is_near = |depth: f32| (depth - mean).abs() <= ALIKE * mean;
            phantoms += u32::from(!self.square([x * ratio, y * ratio], ratio).any(is_near));
            all += 1;
        }
        f64::from(phantoms) / f64::from(all.max(1))
    }

    /// Returns the mean share of the eight neighbours of a pixel that are nearer than it, over all that are covered and
    /// have eight: what ambient occlusion in screen space rests on. 0 for a surface without steps.
    #[must_use]
    pub fn occlusion(&self) -> f64 {
        let [width, height] = self.size;
        let (mut nearer, mut all) = (0_u32, 0_u32);
        for y in 1..height.saturating_sub(1) {
            for x in 1..width.saturating_sub(1) {
                let here = self.values[(y * width + x) as usize];
                if here.is_finite() {
                    nearer += self
                        .square([x - 1, y - 1], 3)
                        .map(|depth| u32::from(depth < here * (1.0 - ALIKE)))
                        .sum::<u32>();
                    all += 8;
                }
            }
        }
        f64::from(nearer) / f64::from(all.max(1))
    }

    /// Returns the buffer in grey, near dark and far bright, each depth a square of so many pixels along each side.
    #[must_use]
    pub fn picture(&self, side: u32) -> RgbImage {
        let seen = || self.values.iter().copied().filter(|depth| depth.is_finite());
        let (near, far) = (seen().fold(f32::INFINITY, f32::min), seen().fold(0.0, f32::max));
        let range = (far - near).max(f32::MIN_POSITIVE);
        RgbImage::from_fn(self.size[0] * side, self.size[1] * side, |x, y| {
            let depth = self.values[(y / side * self.size[0] + x / side) as usize];
            let share = if depth.is_finite() { 0.2 + 0.6 * (depth - near) / range } else { 1.0 };
            Rgb([(share * 255.0).round() as u8; 3])
        })
    }

    /// Returns what a scene measures of it, by name.
    #[must_use]
    pub fn measures(&self, table: &DepthBuffer) -> [(&'static str, f64); 2] {
        [("depth.phantoms", self.phantoms(table.ratio.get())), ("depth.occlusion", self.occlusion())]
    }

    fn square(&self, [left, top]: [u32; 2], side: u32) -> impl Iterator<Item = f32> {
        let row = move |y: u32| (left..left + side).map(move |x| y * self.size[0] + x);
        (top..top + side).flat_map(row).map(|at| self.values[at as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threshold::stage::stipple::{Density, keeps};

    fn depth(size: [u32; 2], of: impl Fn([u32; 2]) -> f32) -> Depth {
        Depth { size, values: (0..size[0] * size[1]).map(|at| of([at % size[0], at / size[0]])).collect() }
    }

    #[test]
    fn a_perforated_surface_becomes_phantoms_and_pits_and_a_tilted_one_does_not() {
        let stippled = |density| depth([18, 18], move |p| if keeps(density, p) { 10.0 } else { 15.0 });
        let tilted = depth([18, 18], |[x, y]| 10.0 + 0.02 * (x + y) as f32);
        assert_eq!((tilted.phantoms(2), tilted.phantoms(3), tilted.occlusion()), (0.0, 0.0, 0.0));
        for density in [Density::High, Density::Low] {
            assert_eq!(stippled(density).phantoms(2), 1.0);
            assert_eq!(stippled(density).phantoms(1), 0.0);
            assert_eq!(stippled(density).occlusion(), 0.25);
        }
        // Every third pixel along each axis: blocks of one, two or four holes, each with a mean of its own.
        let mut means = stippled(Density::High).smaller(3).values;
        means.sort_by(f32::total_cmp);
        means.dedup();
        assert_eq!(means.len(), 3);
    }

    #[test]
    fn what_nothing_covers_is_not_measured() {
        let sky = depth([9, 9], |_| f32::INFINITY);
        assert_eq!((sky.phantoms(2), sky.occlusion()), (0.0, 0.0));
        assert_eq!(sky.picture(2).get_pixel(3, 3).0, [255; 3]);
        assert!(depth([2, 1], |_| 1.0).smaller(4).values.is_empty());
    }
}
