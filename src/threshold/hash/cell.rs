//! Cells, their words, and what a hash of them is.

use crate::threshold::real::Real;

/// One cell of the grid that cuts space at one scale (a *voxel* in the paper's Fig. 6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell<R: Real> {
    /// Integral coordinates, each counted in cells of its own axis.
    pub index: R::Vec3,
    /// The octave as one word, see [`octave_word`]. The paper's hash does not read it.
    pub octave: u32,
}

impl<R: Real> Cell<R> {
    /// Returns x, y, z as the low 32 bits of their two's complement, and the octave.
    ///
    /// Distinct cells give distinct words as long as each coordinate is in [-2^31, 2^31).
    #[inline(always)]
    #[must_use]
    pub fn words(&self) -> [u32; 4] {
        let [x, y, z]: [R; 3] = self.index.into();
        // A sum keeps NaN; a maximum would not.
        let [x, y, z] = if x.abs() + y.abs() + z.abs() < R::SMALL {
            [x.small_word(), y.small_word(), z.small_word()]
        } else {
            [x.to_word(), y.to_word(), z.to_word()]
        };
        [x, y, z, self.octave]
    }
}

/// Packs the octave of each axis into one word.
///
/// Equal octaves give that octave in two's complement, so a cubic cell of the anisotropic grid is the cell of the
/// isotropic one. Injective while every octave is in (-1024, 1024) and two of them differ by less than 512. Not in
/// the paper.
#[inline(always)]
#[must_use]
pub fn octave_word([x, y, z]: [i32; 3]) -> u32 {
    let word =
        x.wrapping_add(y.wrapping_sub(x).wrapping_shl(11)).wrapping_add(z.wrapping_sub(x).wrapping_shl(21));
    word as u32
}

/// Maps a word to the open lattice: (2k + 1) / 2^24 where k holds the upper 23 bits.
///
/// The value is in [2^-24, 1 - 2^-24], exact in `f32` and `f64`, symmetric about 1/2, never 0 and never 1. Not in
/// the paper, whose hash takes 0 with a probability of 4e-4 in `f32`.
#[inline(always)]
#[must_use]
pub fn open_lattice<R: Real>(word: u32) -> R {
    R::from_f64(f64::from(2 * (word >> 9) + 1) * (1.0 / 16_777_216.0))
}

/// A hash of cells. Implement it to put a hash of your own on trial.
///
/// ```
/// use hashed_alpha::threshold::{hash::{Cell, Hash, open_lattice}, real::Real};
///
/// struct Weak;
/// impl<R: Real> Hash<R> for Weak {
///     fn hash(&self, cell: &Cell<R>) -> R {
///         let [x, y, z, octave] = cell.words();
///         open_lattice((x ^ y.rotate_left(8) ^ z.rotate_left(16) ^ octave).wrapping_mul(0x9e37_79b9))
///     }
/// }
/// ```
pub trait Hash<R: Real>: Sync {
    /// Returns the value of `cell`; the paper asks for a uniform law on [0, 1) (§5).
    fn hash(&self, cell: &Cell<R>) -> R;

    /// Returns the values of several cells, those of [`Hash::hash`]; a hash that is chosen at run time chooses once for all.
    #[inline(always)]
    fn hash_all<const N: usize>(&self, cells: [Cell<R>; N]) -> [R; N]
    where
        Self: Sized,
    {
        let mut values = [R::from_f64(0.0); N];
        for (value, cell) in values.iter_mut().zip(&cells) {
            *value = self.hash(cell);
        }
        values
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn open_lattice_is_symmetric_and_never_zero_or_one() {
        for word in [0, 1, 511, 512, 0x7fff_ffff, 0x8000_0000, u32::MAX] {
            let (value, mirrored) = (open_lattice::<f64>(word), open_lattice::<f64>(!word));
            assert!(value > 0.0 && value < 1.0);
            assert_eq!(value + mirrored, 1.0);
            assert_eq!(f64::from(open_lattice::<f32>(word)), value);
        }
        assert_eq!(open_lattice::<f64>(0), 1.0 / 16_777_216.0);
    }

    #[test]
    fn octave_word_tells_octaves_apart_and_keeps_equal_ones() {
        let mut seen = std::collections::HashSet::new();
        for x in (-140..=120).step_by(13) {
            assert_eq!(octave_word([x; 3]), x as u32);
            for y in (-140..=120).step_by(13) {
                for z in (-140..=120).step_by(13) {
                    assert!(seen.insert(octave_word([x, y, z])), "{x} {y} {z}");
                }
            }
        }
    }

    #[test]
    fn words_are_twos_complement() {
        let cell = Cell::<f32> { index: glam::vec3(-1.0, 3.0e9, 2.0), octave: 7 };
        assert_eq!(cell.words(), [u32::MAX, 3_000_000_000, 2, 7]);
    }
}
