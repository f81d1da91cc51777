//! Alpha maps and their levels.

use crate::measure::value;
use hashed_alpha::technique::prior_work::Level;

pub struct Map {
    pub texels: Vec<f32>,
    pub side: usize,
}

impl Map {
    pub fn level(&self) -> Level<'_> {
        Level { texels: &self.texels, width: self.side, height: self.side }
    }

    fn coarser(&self) -> Self {
        let side = self.side / 2;
        let at = |x: usize, y: usize| self.texels[y * self.side + x];
        let mean = |i: usize| {
            let (x, y) = (2 * (i % side), 2 * (i / side));
            0.25 * (at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1))
        };
        Self { texels: (0..side * side).map(mean).collect(), side }
    }

    /// The map and its levels, made by a box filter, down to one texel.
    pub fn chain(self) -> Vec<Self> {
        let mut levels = vec![self];
        while let Some(last) = levels.last().filter(|last| last.side > 1) {
            let next = last.coarser();
            levels.push(next);
        }
        levels
    }

    /// Alpha at a place in texels, bilinear, repeated beyond the borders.
    pub fn at(&self, x: f64, y: f64) -> f64 {
        let (x, y) = (x - 0.5, y - 0.5);
        let (column, row) = (x.floor(), y.floor());
        let (u, v) = (x - column, y - row);
        let texel = |dx: f64, dy: f64| {
            let wrap = |c: f64| (c as i64).rem_euclid(self.side as i64) as usize;
            f64::from(self.texels[wrap(row + dy) * self.side + wrap(column + dx)])
        };
        (1.0 - v) * ((1.0 - u) * texel(0.0, 0.0) + u * texel(1.0, 0.0))
            + v * ((1.0 - u) * texel(0.0, 1.0) + u * texel(1.0, 1.0))
    }
}

fn binary(side: usize, opaque: impl Fn(usize, usize) -> bool) -> Map {
    let texels = (0..side * side).map(|i| f32::from(u8::from(opaque(i % side, i / side)))).collect();
    Map { texels, side }
}

/// Wires of one texel every eighth row and column: opaque on 23 %.
pub fn fence(side: usize) -> Map {
    binary(side, |x, y| x % 8 == 3 || y % 8 == 3)
}

/// Fourteen strands of hair, three texels thick, that hang down by different lengths.
pub fn strands(side: usize) -> Map {
    let strands: Vec<_> = (0..14).map(|strand| [0, 1].map(|which| value([strand, which, 2, 0]))).collect();
    let place = |c: usize| (c as f64 + 0.5) / side as f64;
    binary(side, |x, y| {
        strands.iter().any(|&[at, length]| {
            let bent = 0.05 + 0.9 * at + 0.02 * libm::sin(6.0 * place(y) + 20.0 * length);
            place(y) < 0.55 + 0.45 * length && (place(x) - bent).abs() < 0.006
        })
    })
}

/// Discs of random place and size: opaque on about a third.
pub fn leaves(side: usize) -> Map {
    let discs: Vec<_> = (0..60).map(|leaf| [0, 1, 2].map(|which| value([leaf, which, 0, 0]))).collect();
    let place = |c: usize| (c as f64 + 0.5) / side as f64;
    binary(side, |x, y| {
        discs.iter().any(|&[cx, cy, size]| {
            let (dx, dy, r) = (place(x) - cx, place(y) - cy, 0.02 + 0.05 * size);
            dx * dx + dy * dy < r * r
        })
    })
}

/// Texels that are opaque or clear by the toss of a coin.
pub fn noise(side: usize) -> Map {
    binary(side, |x, y| value([x as u32, y as u32, 1, 9]) < 0.5)
}

/// What `map` leaves free.
pub fn inverse(map: &Map) -> Map {
    Map { texels: map.texels.iter().map(|alpha| 1.0 - alpha).collect(), side: map.side }
}
