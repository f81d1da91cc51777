//! Independent thresholds for the frames of temporal antialiasing: offsets, or a word for the frame (§7.2.2, §9).

use crate::threshold::footprint::Footprint;
use crate::threshold::hash::mm4::murmur3;
use crate::threshold::hash::offset::Offset;
use crate::threshold::hash::{Cell, Hash};
use crate::threshold::model::Model;
use crate::threshold::real::Real;
use core::num::NonZeroU32;

/// Frames with hashes of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Independence {
    /// Number of frames that belong together.
    pub frames: NonZeroU32,
    /// How their hashes are made independent.
    pub by: IndependentBy,
}

/// How the hashes of frames are made independent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum IndependentBy {
    /// Cells are shifted (§7.2.2), [`by_offset`].
    #[default]
    Offset,
    /// The octave word, for hashes that read it, [`ByFrame`]; not in the paper.
    Word,
}

impl Independence {
    /// Returns the threshold of a footprint in a frame.
    pub(in crate::threshold) fn threshold<R: Real>(
        self,
        model: Model,
        footprint: &Footprint<R>,
        frame: u32,
    ) -> R {
        let (hash, frame) = (*model.hash(), frame % self.frames);
        match self.by {
            IndependentBy::Offset => model.with_hash(by_offset::<R, _>(hash, frame)).threshold(footprint),
            IndependentBy::Word => model.with_hash(ByFrame { hash, frame }).threshold(footprint),
        }
    }
}

/// Offsets along each axis stay below this number of cells, so that `f32` still holds cells to which they are added.
const FARTHEST_OFFSET: u32 = 4096;

/// Returns a hash for frame `i` out of `hash`, by an offset of whole cells: `hash(hashInput.xyz + offset[i])` of §7.2.2.
///
/// The paper leaves the list of unique offsets to the reader; this one is drawn by MurmurHash3 from [-4096, 4096)^3,
/// with none for frame 0. Two frames see the same field of noise at another place, which is independent in one cell and
/// not over a surface; small offsets would show it.
#[must_use]
pub fn by_offset<R: Real, H>(hash: H, i: u32) -> Offset<H, R> {
    let component = |axis: u32| {
        let word = murmur3([i, axis, 0, 0]) % (2 * FARTHEST_OFFSET);
        R::from_f64(if i == 0 { 0.0 } else { f64::from(word) - f64::from(FARTHEST_OFFSET) })
    };
    Offset { hash, offset: [component(0), component(1), component(2)].into() }
}

/// Hashes a cell together with a frame, or any other number that tells samples apart (the two of §9), by way of the
/// octave word; frame 0 is the hash itself.
///
/// For hashes that read the octave: others, the paper's among them, do not see the frame. Not in the paper.
#[derive(Clone, Copy, Debug)]
pub struct ByFrame<H> {
    /// The hash that is asked.
    pub hash: H,
    /// Which frame or sample.
    pub frame: u32,
}

impl<R: Real, H: Hash<R>> Hash<R> for ByFrame<H> {
    fn hash(&self, cell: &Cell<R>) -> R {
        // An odd factor, so that frames below 2^32 give different words; a large one, so that none is another's octave.
        let octave = cell.octave ^ self.frame.wrapping_mul(0x9e37_79b9);
        self.hash.hash(&Cell { octave, ..*cell })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::threshold::hash::HashKind;
    use crate::threshold::hash::sine::Sine;

    fn cells(z: f64) -> impl Iterator<Item = Cell<f64>> {
        (0..64 * 64).map(move |i| Cell { index: [f64::from(i % 64), f64::from(i / 64), z].into(), octave: 3 })
    }

    fn correlation(pairs: impl Iterator<Item = (f64, f64)>) -> f64 {
        let (mut n, mut sums) = (0.0, [0.0; 5]);
        for (a, b) in pairs {
            n += 1.0;
            for (sum, term) in sums.iter_mut().zip([a, b, a * a, b * b, a * b]) {
                *sum += term;
            }
        }
        let [a, b, aa, bb, ab] = sums.map(|sum| sum / n);
        (ab - a * b) / ((aa - a * a) * (bb - b * b)).sqrt()
    }

    /// "Separate regions of hash space are also independent."
    #[test]
    fn frames_do_not_correlate_in_a_cell() {
        for frame in 1..9 {
            let sine =
                correlation(cells(5.0).map(|cell| (Sine.hash(&cell), by_offset(Sine, frame).hash(&cell))));
            let word = ByFrame { hash: HashKind::Mm4, frame };
            let word = correlation(cells(5.0).map(|cell| (HashKind::Mm4.hash(&cell), word.hash(&cell))));
            // Five standard deviations of 4096 pairs.
            assert!(sine.abs() < 5.0 / 64.0 && word.abs() < 5.0 / 64.0, "{frame}: {sine} {word}");
        }
    }

    /// Offsets of one cell a frame: the mean of eight frames is the same in neighbours but for one of eight terms.
    #[test]
    fn small_offsets_only_scroll_the_noise() {
        let mean = |cell: &Cell<f64>, offset: &dyn Fn(u32) -> [f64; 3]| {
            let of = |i| Offset { hash: HashKind::Mm4, offset: offset(i).into() }.hash(cell);
            (0..8).map(of).sum::<f64>() / 8.0
        };
        let neighbours = |offset: &dyn Fn(u32) -> [f64; 3]| {
            correlation(cells(5.0).map(|cell| {
                let [x, y, z]: [f64; 3] = cell.index.into();
                let next = Cell { index: [x + 1.0, y, z].into(), ..cell };
                (mean(&cell, offset), mean(&next, offset))
            }))
        };
        let scrolled = neighbours(&|i| [f64::from(i), 0.0, 0.0]);
        assert!((scrolled - 7.0 / 8.0).abs() < 0.03, "{scrolled}");
        let far = neighbours(&|i| by_offset::<f64, _>(HashKind::Mm4, i).offset.into());
        assert!(far.abs() < 5.0 / 64.0, "{far}");
    }

    #[test]
    fn frame_0_is_the_hash_itself_and_the_sine_sees_no_frame() {
        let cell = Cell::<f32> { index: glam::vec3(3.0, -5.0, 8.0), octave: u32::MAX };
        assert_eq!(ByFrame { hash: HashKind::Mm4, frame: 0 }.hash(&cell), HashKind::Mm4.hash(&cell));
        assert_ne!(ByFrame { hash: HashKind::Mm4, frame: 1 }.hash(&cell), HashKind::Mm4.hash(&cell));
        assert_eq!(ByFrame { hash: Sine, frame: 1 }.hash(&cell), Sine.hash(&cell));
        assert_eq!(by_offset(Sine, 0).hash(&cell), Sine.hash(&cell));
        assert_ne!(by_offset(Sine, 1).hash(&cell), Sine.hash(&cell));
    }
}
