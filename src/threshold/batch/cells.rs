//! From octaves to cells, and from cells to hashes, block by block.

use super::block::{BLOCK, Block};
use super::columns::BlockColumns;
use super::lane::Kernel;
use super::plan::Plan;
use super::tier::Tier;
use crate::threshold::hash::{self, HashKind, OfBlocks, octave_word};

/// Writes the coordinates of the cells of given octaves, of one for all axes or of one an axis.
#[inline(always)]
pub(super) fn at_octaves<R: Kernel, const FUSED: bool>(
    plan: &Plan<R>,
    block: &BlockColumns<'_, R>,
    octave: &[Block<i32>; 3],
    index: &mut [Block<R>; 3],
) {
    let one = R::from_f64(1.0);
    let thirds = [2.0 / 3.0, 1.0 / 3.0].map(R::from_f64);
    for axis in 0..3 {
        let (octave, position, index) =
            (&octave[axis.min(plan.axes - 1)], block.position[axis], &mut index[axis]);
        if plan.nested_phase {
            for i in 0..BLOCK {
                let scaled = R::power(octave[i]) * position[i];
                let whole = scaled.lane_floor::<FUSED>();
                let third = if octave[i] & 1 == 0 { thirds[0] } else { thirds[1] };
                index[i] = if scaled - whole >= third { whole + one } else { whole };
            }
        } else {
            for i in 0..BLOCK {
                index[i] = (R::power(octave[i]) * position[i]).lane_floor::<FUSED>();
            }
        }
    }
}

/// Writes the coordinates of the cells of given scales, equal along all axes.
#[inline(always)]
pub(super) fn at_scale<R: Kernel, const FUSED: bool>(
    block: &BlockColumns<'_, R>,
    scale: &Block<R>,
    index: &mut [Block<R>; 3],
) {
    for axis in 0..3 {
        for i in 0..BLOCK {
            index[axis][i] = (scale[i] * block.position[axis][i]).lane_floor::<FUSED>();
        }
    }
}

/// Writes the words of given octaves, of which only the first counts where one is that of all axes.
#[inline(always)]
pub(super) fn words<R>(plan: &Plan<R>, [x, y, z]: [&Block<i32>; 3], word: &mut Block<u32>) {
    if !plan.octave_word {
        *word = [0; BLOCK];
    } else if plan.axes == 1 {
        for i in 0..BLOCK {
            word[i] = x[i] as u32;
        }
    } else {
        for i in 0..BLOCK {
            word[i] = octave_word([x[i], y[i], z[i]]);
        }
    }
}

/// Hashes cells: their coordinates along each axis, and the words of their octaves.
#[inline(always)]
pub(super) fn hash<R: Kernel, const FUSED: bool>(
    kind: HashKind,
    tier: Tier,
    index: [&Block<R>; 3],
    word: &Block<u32>,
    out: &mut Block<R>,
) {
    macro_rules! by_kind {
        ($($kind:ident = $file:ident, $doc:literal;)*) => {
            match kind {
                $(HashKind::$kind => hash_by::<R, hash::$file::$kind, FUSED>(tier, index, word, out),)*
            }
        };
    }
    hash::hashes!(by_kind);
}

#[inline(always)]
fn hash_by<R: Kernel, H: OfBlocks, const FUSED: bool>(
    tier: Tier,
    index: [&Block<R>; 3],
    word: &Block<u32>,
    out: &mut Block<R>,
) {
    if !H::ASKS_SINE {
        return H::block::<R, FUSED>(R::sine_fast, index, word, out);
    }
    match tier {
        Tier::Coarse => H::block::<R, FUSED>(R::sine_coarse, index, word, out),
        Tier::Fast => H::block::<R, FUSED>(R::sine_fast, index, word, out),
        Tier::TwoUlp => H::block::<R, FUSED>(R::sine_two_ulp, index, word, out),
        Tier::BitExact => H::block::<R, FUSED>(R::sine::<FUSED>, index, word, out),
    }
}
