//! Blocks of neighbouring cells of one octave.

use crate::check::input::cell::{between, draw_octave};
use crate::check::input::patch::Start;
use crate::check::tolerance::SPREAD;
use crate::check::trial::reject_outsiders;
use crate::check::{Attempt, Subject};
use crate::scene::Fragment;
use crate::stats::seed;
use glam::DVec3;
use rand::rngs::Xoshiro256PlusPlus;

/// Cells that are evaluated at a time: their footprints fill some megabytes.
const CELLS_AT_ONCE: usize = 1 << 16;

/// The scale, in octaves above its own, at which a block is seen a second time: there a threshold is made of two hashes, and
/// one that is sound for a single hash only is found out.
pub(crate) const BETWEEN: f64 = 0.5;

/// A block of cells of one octave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Block {
    /// Cells along each axis.
    pub size: [usize; 3],
    /// The cell with the lowest indices.
    pub corner: DVec3,
    /// The octave.
    pub octave: i32,
    /// How far its scale is from that of the octave to the next finer one, in [0, 1): at 0 the octave has all weight.
    pub fraction: f64,
    /// Where the first cell is seen; each of a layer in a pixel of its own.
    pub start: Start,
}

impl Block {
    /// Draws the octave and the place of a block: around the origin as far as it is long and at least [`SPREAD`], so that
    /// indices of both signs come in.
    pub fn draw(size: [usize; 3], rng: &mut Xoshiro256PlusPlus) -> Self {
        let corner = size.map(|side| {
            let reach = SPREAD.max(side as f64);
            ((2.0 * seed::uniform01(rng) - 1.0) * reach - 0.5 * side as f64).floor()
        });
        Self {
            size,
            corner: DVec3::from_array(corner),
            octave: draw_octave(rng),
            fraction: 0.0,
            start: Start::draw(rng),
        }
    }

    /// Returns the same cells at another scale: none shares a cell of any finer octave with another.
    pub fn seen_at(self, fraction: f64) -> Self {
        Self { fraction, ..self }
    }

    /// Returns the number of cells.
    pub fn cells(&self) -> usize {
        self.size.iter().product()
    }

    /// Evaluates every cell once, the first axis the fastest.
    pub fn thresholds(&self, subject: &Subject<'_>) -> Attempt<Vec<f64>> {
        let [nx, ny, _] = self.size;
        let n = self.cells();
        let mut values = Vec::with_capacity(n);
        for first in (0..n).step_by(CELLS_AT_ONCE) {
            let cells: Vec<Fragment> = (first..n.min(first + CELLS_AT_ONCE))
                .map(|at| [at % nx, at / nx % ny, at / (nx * ny)].map(|index| index as f64))
                .map(|index| {
                    let index = DVec3::from_array(index);
                    let seen =
                        self.start.seeing(between(subject, self.corner + index, self.octave, self.fraction));
                    Fragment { pixel: seen.pixel + index.truncate(), ..seen }
                })
                .collect();
            let found = subject.thresholds(&cells);
            reject_outsiders(subject, &cells, &found)?;
            values.extend(found);
        }
        Ok(values)
    }
}

/// The sides of a block of 2^`bits` cells that are as equal as powers of two can be, in an order drawn.
pub(crate) fn cube(bits: u32, rng: &mut Xoshiro256PlusPlus) -> [usize; 3] {
    let mut sides = [2, 1, 0].map(|more| 1 << ((bits + more) / 3));
    sides.rotate_left((3.0 * seed::uniform01(rng)) as usize);
    sides
}
