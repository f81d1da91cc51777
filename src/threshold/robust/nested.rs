//! Cells whose thresholds depend on those of the cells around them in the octave before: the joins that are nested. Not in the
//! paper, whose octaves are independent.
//!
//! With [`Repair::NestedPhase`] a cell of one octave is the union of eight of the next one, its
//! *children*. If a child keeps the threshold of its *parent*, nothing changes there while the camera comes an octave closer.
//!
//! * One scale: the children make four *pairs* of opposite corners, and each slab of the parent along an axis
//!   has one child of each pair. One pair keeps the threshold of the parent. The other three share the rest: each is in a third of
//!   [0, 1] of its own, so that the number of visible ones of four varies as little as can be, and no plane along two axes shows more of them
//!   than another.
//! * One scale an axis: along each axis one of two children keeps the name of its parent, and a cell is hashed by
//!   the names of its three intervals. No two cells beside each other have one name, so that thresholds are as independent as
//!   the hash makes them.

use super::repairs::{Repair, Repairs};
use crate::threshold::hash::{Cell, Hash, octave_word};
use crate::threshold::real::Real;

/// How many parents are asked, one after the other, for the threshold that a cell keeps; where all of them keep, the hash of the last one is taken.
/// One cell in 256 is asked so often, and with it flips are 0.5 % more than without an end.
pub(crate) const LEVELS: u32 = 4;

/// How many octaves a name is kept along an axis, at most: one interval in 65,536 has kept it so long.
pub(crate) const LONGEST_NAME: u32 = 16;

/// Where the intervals of an octave begin to be counted so that each has the intervals `2 n` and `2 n + 1` of the next octave as
/// its children, in two's complement: nested cells begin at alternating thirds, whose digits alternate.
#[inline(always)]
fn origin(octave: i32, nested_phase: bool) -> u32 {
    match (nested_phase, octave & 1) {
        (false, _) => 0,
        (true, 0) => 0x5555_5555,
        (true, _) => 0xaaaa_aaaa,
    }
}

/// The index of an ancestor of an interval, so many octaves above.
#[inline(always)]
fn ancestor(index: i32, origin: u32, octaves: u32) -> i32 {
    let beyond = origin & ((1 << octaves) - 1);
    index.wrapping_add(beyond as i32) >> octaves
}

/// The pair of a cell whose intervals have these numbers, 0 to 3: two opposite corners have the same.
#[inline(always)]
fn pair([x, y, z]: [u32; 3]) -> u32 {
    ((x ^ z) & 1) | (((y ^ z) & 1) << 1)
}

/// A word of a parent, from the numbers of its intervals: its two upper bits say which pair keeps the threshold, the next ones how the
/// others are ordered.
///
/// It decides which of four pairs has which share; thresholds come from the hash. lowbias32 but for its last step (C. Wellons,
/// hash-prospector, 2018): without the first one, parallel layers some powers of two apart had related orders. The word repeats after
/// 2^11, 2^11 and 2^10 cells.
#[inline(always)]
fn order_of_pairs([x, y, z]: [u32; 3], octave: i32) -> u32 {
    let packed = (x & 0x7ff) | ((y & 0x7ff) << 11) | (z << 22);
    let folded = packed ^ (packed >> 16) ^ (octave as u32).rotate_left(16);
    let mixed = folded.wrapping_mul(0x7feb_352d);
    (mixed ^ (mixed >> 15)).wrapping_mul(0x846c_a68b)
}

/// Whether a pair keeps the threshold of its parent.
#[inline(always)]
fn keeps(order: u32, pair: u32) -> bool {
    order >> 30 == pair
}

/// The share that a pair has of [0, 1]: 0 for all of it, which the pair that keeps the threshold has; 1, 2 or 3 for a third.
///
/// Any two of four pairs have any two shares equally often: the pair that keeps is any, and the other three follow in one of
/// three orders.
#[inline(always)]
fn share_of_pair(order: u32, pair: u32) -> u32 {
    let after_keeper = pair ^ (order >> 30);
    // 0, 1 or 2; one in 65,536 times more often the one than the other.
    let turn = ((order >> 14 & 0xffff) * 3) >> 16;
    let turned = after_keeper + turn;
    if keeps(order, pair) { 0 } else { turned - if turned > 3 { 3 } else { 0 } }
}

/// The threshold of a pair's child by its share, from the hash of the parent, in [0, 1]: the two cells of a pair have values half
/// a unit apart.
#[inline(always)]
pub(in crate::threshold) fn of_share<R: Real>(share: u32, upper: bool, hash: R) -> R {
    let [zero, half, one, two, third] = [0.0, 0.5, 1.0, 2.0, 1.0 / 3.0].map(R::from_f64);
    // Exact: no sum of both exceeds 1.
    let opposite = if hash < half { hash + half } else { hash - half };
    let value = if upper { opposite } else { hash };
    let below = if share == 3 { two } else { zero } + if share == 2 { one } else { zero };
    if share == 0 { value } else { (below + value) * third }
}

/// The cell from whose hash the threshold of a cell comes, and its share of it.
#[derive(Clone, Copy, Debug)]
pub(in crate::threshold) struct Source {
    pub index: [i32; 3],
    pub octave: i32,
    /// As [`share_of_pair`] returns it.
    pub share: u32,
    /// Whether the cell is in the upper half of its parent along z.
    pub upper: bool,
}

impl Source {
    /// Finds the source of a cell of one octave along all axes. Without a branch: what a hash decides no predictor foretells, and
    /// a block of cells is looked for at once.
    #[inline(always)]
    pub fn of(index: [i32; 3], octave: i32, nested_phase: bool) -> Self {
        let origin = origin(octave, nested_phase);
        let numbers = index.map(|index| (index as u32).wrapping_add(origin));
        let above = |levels: u32| numbers.map(|number| number >> levels);
        let order = |levels: u32| order_of_pairs(above(levels + 1), octave.wrapping_sub(levels as i32 + 1));
        // So many parents keep a threshold, and their children with it.
        let mut climbed = 0;
        for levels in 0..LEVELS - 1 {
            climbed += u32::from((climbed == levels) & keeps(order(levels), pair(above(levels))));
        }
        let at = above(climbed);
        Self {
            index: index.map(|index| ancestor(index, origin, climbed + 1)),
            octave: octave.wrapping_sub(climbed as i32 + 1),
            share: share_of_pair(order(climbed), pair(at)),
            upper: at[2] & 1 == 1,
        }
    }
}

/// Returns the threshold of a cell of one octave along all axes, in (0, 1], from the octaves above it.
#[inline(always)]
pub(super) fn inherited<R: Real, H: Hash<R>>(hash: &H, index: [R; 3], octave: i32, repairs: Repairs) -> R {
    let index = index.map(|index| index.to_word() as i32);
    let source = Source::of(index, octave, repairs.contains(Repair::NestedPhase));
    let index = source.index.map(|index| R::from_f64(f64::from(index)));
    let word = if repairs.contains(Repair::OctaveWord) { octave_word([source.octave; 3]) } else { 0 };
    of_share(source.share, source.upper, hash.hash(&Cell { index: index.into(), octave: word }))
}

/// Returns the interval whose name an interval of an axis has, with its octave: itself if it is the upper one of two, or the first
/// of its ancestors that is. Index and result are whole numbers in two's complement.
#[inline(always)]
pub(crate) fn named(index: i32, octave: i32, nested_phase: bool) -> (i32, i32) {
    let origin = origin(octave, nested_phase);
    let number = (index as u32).wrapping_add(origin);
    let kept = (number | 1 << LONGEST_NAME).trailing_zeros();
    (ancestor(index, origin, kept), octave.wrapping_sub(kept as i32))
}
