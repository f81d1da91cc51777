//! Cells that inherit, block by block: from chosen cells to those that are hashed in their place.

use super::block::{BLOCK, Block};
use super::lane::Kernel;
use super::plan::Plan;
use crate::threshold::hash::octave_word;
use crate::threshold::robust::nested::{Source, named, of_share};

/// What cells have of their parents, where there is one scale.
pub(super) struct Shares {
    share: Block<u32>,
    upper: Block<bool>,
}

impl Shares {
    #[inline(always)]
    pub fn new() -> Self {
        Self { share: [0; BLOCK], upper: [false; BLOCK] }
    }

    /// Puts the parents in the place of cells, those from whom the thresholds come, and notes what share the cells have.
    #[inline(always)]
    pub fn find<R: Kernel>(
        &mut self,
        plan: &Plan<R>,
        [x, y, z]: &mut [Block<R>; 3],
        octave: &Block<i32>,
        word: &mut Block<u32>,
    ) {
        for i in 0..BLOCK {
            let index = [x[i], y[i], z[i]].map(|index| index.small_word() as i32);
            let source = Source::of(index, octave[i], plan.nested_phase);
            self.share[i] = source.share;
            self.upper[i] = source.upper;
            [x[i], y[i], z[i]] = source.index.map(R::whole);
            word[i] = if plan.octave_word { source.octave as u32 } else { 0 };
        }
    }

    /// Writes the thresholds, from the hashes of the parents.
    #[inline(always)]
    pub fn of_hashes<R: Kernel>(&self, hash: &Block<R>, out: &mut Block<R>) {
        for i in 0..BLOCK {
            out[i] = of_share(self.share[i], self.upper[i], hash[i]);
        }
    }
}

/// Puts the cells whose names the intervals have in the place of cells with one octave an axis.
#[inline(always)]
pub(super) fn names<R: Kernel>(
    plan: &Plan<R>,
    index: &mut [Block<R>; 3],
    octave: &[Block<i32>; 3],
    word: &mut Block<u32>,
) {
    for i in 0..BLOCK {
        let [x, y, z] = [0, 1, 2]
            .map(|axis| named(index[axis][i].small_word() as i32, octave[axis][i], plan.nested_phase));
        index[0][i] = R::whole(x.0);
        index[1][i] = R::whole(y.0);
        index[2][i] = R::whole(z.0);
        word[i] = if plan.octave_word { octave_word([x.1, y.1, z.1]) } else { 0 };
    }
}
