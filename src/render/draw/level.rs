//! Levels of a mip chain, each made of the one before.

use super::sampler::{Filter, Sampler};
use crate::technique::prior_work;
use rayon::prelude::*;

/// One level of a mip chain, row by row from the upper edge (texture coordinate y = 0).
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Width and height in texels, at least 1.
    pub size: [u32; 2],
    /// Alpha of each texel, in [0, 1].
    pub alpha: Vec<f32>,
    /// Colour of each texel as shares of 65535; empty for a texture that has none.
    pub colour: Vec<[u16; 3]>,
}

impl Level {
    /// Index of a texel that is inside.
    #[inline]
    pub(super) fn index(&self, x: usize, y: usize) -> usize {
        y * self.size[0] as usize + x
    }

    /// Returns its alphas as prior work sees them.
    #[must_use]
    pub fn alphas(&self) -> prior_work::Level<'_> {
        let [width, height] = self.size.map(|side| side as usize);
        prior_work::Level { texels: &self.alpha, width, height }
    }
}

/// Multiplies colours by alpha (§7.3).
pub(super) fn premultiply(mut level: Level) -> Level {
    for (colour, &alpha) in level.colour.iter_mut().zip(&level.alpha) {
        *colour = colour.map(|share| (f32::from(share) * alpha).round() as u16);
    }
    level
}

/// Places along each side of a texel at which [`tested`] asks: its shares come in steps of 1/256.
const PLACES: usize = 16;

/// The share of each texel of a finest level that a test keeps, of the alpha that a sampler makes of it where it is magnified.
pub(super) fn tested(level: &Level, cutoff: f32, sampler: &Sampler) -> Level {
    let is_nearest = sampler.magnified.unwrap_or(sampler.filter) == Filter::Nearest;
    let [width, height] = level.size;
    let row = |y: u32| {
        // The texel and its neighbours, along one axis.
        let beside = |at: u32, axis: usize| {
            [-1, 0, 1].map(|by| sampler.wrap[axis].texel(i64::from(at) + by, level.size[axis]))
        };
        let rows = beside(y, 1);
        (0..width).map(move |x| {
            let columns = beside(x, 0);
            let around = rows.map(|y| columns.map(|x| level.alpha[level.index(x, y)]));
            let all = around.as_flattened();
            let [least, most] =
                [all.iter().fold(1.0_f32, |a, &b| a.min(b)), all.iter().fold(0.0_f32, |a, &b| a.max(b))];
            if is_nearest || least >= cutoff || most < cutoff {
                return f32::from(u8::from(around[1][1] >= cutoff));
            }
            share(&around, cutoff)
        })
    };
    let alpha = (0..height).into_par_iter().flat_map_iter(row).collect();
    Level { size: level.size, alpha, colour: level.colour.clone() }
}

/// The share of the middle texel of nine over which interpolated alpha is at least `cutoff`.
fn share(around: &[[f32; 3]; 3], cutoff: f32) -> f32 {
    // The middles of equal parts of the texel: the first of two neighbours, and how far on from its middle.
    let places: [(usize, f32); PLACES] = core::array::from_fn(|at| {
        let along = (at as f32 + 0.5) / PLACES as f32 + 0.5;
        let first = along as usize;
        (first, along - first as f32)
    });
    let mut kept = 0_u16;
    for (row, down) in places {
        for (column, across) in places {
            let along = |row: usize| {
                let [from, to] = [around[row][column], around[row][column + 1]];
                from + (to - from) * across
            };
            let (upper, lower) = (along(row), along(row + 1));
            kept += u16::from(upper + (lower - upper) * down >= cutoff);
        }
    }
    f32::from(kept) / (PLACES * PLACES) as f32
}

/// For each texel of a side of half the length, the texels that it averages and their weights.
fn shares(side: u32) -> Vec<Vec<(usize, f64)>> {
    let halved = (side / 2).max(1);
    let width = f64::from(side) / f64::from(halved);
    (0..halved)
        .map(|index| {
            let (from, to) = (f64::from(index) * width, f64::from(index + 1) * width);
            (from.floor() as usize..(to.ceil() as usize).min(side as usize))
                .map(|texel| (texel, ((texel + 1) as f64).min(to) - (texel as f64).max(from)))
                .filter(|&(_, weight)| weight > 0.0)
                .map(|(texel, weight)| (texel, weight / width))
                .collect()
        })
        .collect()
}

/// The next level; `None` after the one of a single texel.
pub(super) fn half(level: &Level) -> Option<Level> {
    let [width, height] = level.size;
    if level.size == [1, 1] {
        return None;
    }
    let (columns, rows) = (shares(width), shares(height));
    let mut next = Level {
        size: [(width / 2).max(1), (height / 2).max(1)],
        alpha: Vec::with_capacity(columns.len() * rows.len()),
        colour: Vec::new(),
    };
    for row in &rows {
        for column in &columns {
            let average = |value: &dyn Fn(usize) -> f64| -> f64 {
                row.iter()
                    .flat_map(|&(y, down)| {
                        column.iter().map(move |&(x, across)| (y * width as usize + x, down * across))
                    })
                    .map(|(at, weight)| value(at) * weight)
                    .sum()
            };
            next.alpha.push(average(&|at| f64::from(level.alpha[at])) as f32);
            if !level.colour.is_empty() {
                next.colour
                    .push([0, 1, 2].map(|c| average(&|at| f64::from(level.colour[at][c])).round() as u16));
            }
        }
    }
    Some(next)
}
