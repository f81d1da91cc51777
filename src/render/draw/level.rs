//! Levels of a mip chain, each made of the one before.

use crate::technique::prior_work;

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
