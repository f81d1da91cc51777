//! From octaves to cells, and from cells to hashes, block by block.

use super::columns::BlockColumns;
use super::lane::Kernel;
use super::plan::Plan;
use super::{BLOCK, Block, Tier};
use crate::threshold::hash::sine::hash_2d_by;
use crate::threshold::hash::{HashKind, integer, octave_word};

/// The cells of a block.
pub(super) struct Cells<R> {
    pub index: [Block<R>; 3],
    pub word: Block<u32>,
    inner: Block<R>,
}

impl<R: Kernel> Cells<R> {
    #[inline(always)]
    pub fn new() -> Self {
        let zeros = [R::from_f64(0.0); BLOCK];
        Self { index: [zeros; 3], word: [0; BLOCK], inner: zeros }
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
        match kind {
            HashKind::Sine | HashKind::SineChi2 => match tier {
                Tier::Coarse => self.hash_sine(kind, R::sine_coarse, out),
                Tier::Fast => self.hash_sine(kind, R::sine_fast, out),
                Tier::TwoUlp => self.hash_sine(kind, R::sine_two_ulp, out),
                Tier::BitExact => self.hash_sine(kind, R::sine::<FUSED>, out),
            },
            HashKind::Mm4 => self.hash_words(integer::Mm4::word, out),
            HashKind::Xxhash32 => self.hash_words(integer::Xxhash32::word, out),
            HashKind::Pcg3d => self.hash_words(integer::Pcg3d::word, out),
            HashKind::Pcg4d => self.hash_words(integer::Pcg4d::word, out),
            HashKind::PcgNested => self.hash_words(integer::PcgNested::word, out),
        }
    }

    /// Nests the hash of two coordinates: (x, y) then z, or (y, z) then x in the first place.
    #[inline(always)]
    fn hash_sine(&mut self, kind: HashKind, sine: impl Fn(R) -> R + Copy, out: &mut Block<R>) {
        let [x, y, z] = &self.index;
        let (first, second) = if kind == HashKind::Sine { (x, y) } else { (y, z) };
        for i in 0..BLOCK {
            self.inner[i] = hash_2d_by(sine, first[i], second[i]);
        }
        let (first, second) = if kind == HashKind::Sine { (&self.inner, z) } else { (x, &self.inner) };
        for i in 0..BLOCK {
            out[i] = hash_2d_by(sine, first[i], second[i]);
        }
    }

    #[inline(always)]
    fn hash_words(&self, word: impl Fn([u32; 4]) -> u32, out: &mut Block<R>) {
        let [x, y, z] = &self.index;
        for i in 0..BLOCK {
            out[i] = R::lattice(word([x[i].word(), y[i].word(), z[i].word(), self.word[i]]));
        }
    }
}
