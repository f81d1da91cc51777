//! From octaves to cells, and from cells to hashes, block by block.

use super::block::{BLOCK, Block};
use super::columns::BlockColumns;
use super::lane::Kernel;
use super::plan::Plan;
use super::tier::Tier;
use crate::threshold::hash::{self, HashKind, OfBlocks, octave_word};

/// The cells of a block.
pub(super) struct Cells<R> {
    pub index: [Block<R>; 3],
    pub word: Block<u32>,
}

impl<R: Kernel> Cells<R> {
    #[inline(always)]
    pub fn new() -> Self {
        let zeros = [R::from_f64(0.0); BLOCK];
        Self { index: [zeros; 3], word: [0; BLOCK] }
    }

    /// Finds the cells of given octaves, of one for all axes or of one an axis.
    #[inline(always)]
    pub fn at_octaves<const AXES: usize>(
        &mut self,
        plan: &Plan<R>,
        block: &BlockColumns<'_, R>,
        octave: &[Block<i32>; 3],
    ) {
        let one = R::from_f64(1.0);
        let thirds = [2.0 / 3.0, 1.0 / 3.0].map(R::from_f64);
        if plan.nested_phase {
            for i in 0..BLOCK {
                for axis in 0..3 {
                    let octave = octave[axis.min(AXES - 1)][i];
                    let scaled = R::power(octave) * block.position[axis][i];
                    let whole = scaled.floor();
                    let third = if octave & 1 == 0 { thirds[0] } else { thirds[1] };
                    self.index[axis][i] = if scaled - whole >= third { whole + one } else { whole };
                }
            }
        } else {
            for i in 0..BLOCK {
                for axis in 0..3 {
                    let octave = octave[axis.min(AXES - 1)][i];
                    self.index[axis][i] = (R::power(octave) * block.position[axis][i]).floor();
                }
            }
        }
        if !plan.octave_word {
            self.word = [0; BLOCK];
        } else {
            for i in 0..BLOCK {
                self.word[i] = match AXES {
                    1 => octave[0][i] as u32,
                    _ => octave_word([octave[0][i], octave[1][i], octave[2][i]]),
                };
            }
        }
    }

    /// Finds the cells of given scales, equal along all axes.
    #[inline(always)]
    pub fn at_scale(&mut self, block: &BlockColumns<'_, R>, scale: &Block<R>) {
        for i in 0..BLOCK {
            for axis in 0..3 {
                self.index[axis][i] = (scale[i] * block.position[axis][i]).floor();
            }
        }
    }

    /// Hashes the cells.
    #[inline(always)]
    pub fn hash<const FUSED: bool>(&mut self, kind: HashKind, tier: Tier, out: &mut Block<R>) {
        macro_rules! by_kind {
            ($($kind:ident = $file:ident, $doc:literal;)*) => {
                match kind {
                    $(HashKind::$kind => self.hash_by::<hash::$file::$kind, FUSED>(tier, out),)*
                }
            };
        }
        hash::hashes!(by_kind);
    }

    #[inline(always)]
    fn hash_by<H: OfBlocks, const FUSED: bool>(&self, tier: Tier, out: &mut Block<R>) {
        let (index, word) = (&self.index, &self.word);
        match tier {
            Tier::Coarse => H::block(R::sine_coarse, index, word, out),
            Tier::Fast => H::block(R::sine_fast, index, word, out),
            Tier::TwoUlp => H::block(R::sine_two_ulp, index, word, out),
            Tier::BitExact => H::block(R::sine::<FUSED>, index, word, out),
        }
    }
}
