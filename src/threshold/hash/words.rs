//! What hashes of words have in common: the same bits on every machine and in every shading language.
//!
//! None is in the paper, which says that its hash matters less than the properties of that hash (§5.1). Each reads the words
//! of [`Cell::words`](super::Cell::words) and returns a value of [`open_lattice`](super::open_lattice).

/// Declares a unit struct that hashes the words of a cell.
macro_rules! integer_hash {
    ($(#[$doc:meta])* $name:ident, |$words:pat_param| $value:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default)]
        pub struct $name;

        impl $name {
            /// Hashes the words of a cell to one.
            #[inline(always)]
            fn word($words: [u32; 4]) -> u32 {
                $value
            }
        }

        impl<R: $crate::threshold::real::Real> $crate::threshold::hash::cell::Hash<R> for $name {
            #[inline(always)]
            fn hash(&self, cell: &$crate::threshold::hash::cell::Cell<R>) -> R {
                $crate::threshold::hash::cell::open_lattice(Self::word(cell.words()))
            }
        }

        impl $crate::threshold::hash::listed::OfBlocks for $name {
            #[inline(always)]
            fn block<R: $crate::threshold::batch::lane::Kernel, const FUSED: bool>(
                _: impl Fn(R) -> R + Copy,
                [x, y, z]: [&$crate::threshold::batch::block::Block<R>; 3],
                octave: &$crate::threshold::batch::block::Block<u32>,
                out: &mut $crate::threshold::batch::block::Block<R>,
            ) {
                for i in 0..out.len() {
                    out[i] = R::lattice(Self::word([x[i].small_word(), y[i].small_word(), z[i].small_word(), octave[i]]));
                }
            }
        }
    };
}

pub(super) use integer_hash;

/// Mixes the octave, z, y and x one after the other, each added to what came before.
#[inline(always)]
pub(super) fn nested([x, y, z, octave]: [u32; 4], mix: impl Fn(u32) -> u32) -> u32 {
    [octave, z, y, x].into_iter().fold(0, |h, word| mix(h.wrapping_add(word)))
}

/// Returns the sum of words times weights.
#[inline(always)]
pub(super) fn weighted_sum(words: [u32; 4], weights: [u32; 4]) -> u32 {
    words.into_iter().zip(weights).fold(0, |sum, (word, weight)| sum.wrapping_add(word.wrapping_mul(weight)))
}

/// The weights of [`linear_word`].
const WEIGHTS: [u32; 4] = [0xc71f_15df, 0xd288_1b55, 0x6290_e857, 0x6a46_fe4f];

/// The shortest vector of cells after which [`linear_word`] repeats.
pub(super) const LINEAR_REPEATS_AFTER: [i32; 3] = [1746, -205, -235];

/// Returns the words of a cell as one, whatever mixes it afterwards.
///
/// Such a sum repeats: cells of one octave share their word with those (1746, -205, -235) cells on, and with none that are nearer than
/// these 1773.6 cells. No weights could have more than 1824 (2^(1/6) times the cube root of 2^32, by Hermite's constant); those of
/// Jarzynski & Olano 2020, (19, 47, 101), have 9.9. Ours are the best of 26,816 random triples of odd numbers, so that each word alone
/// is a permutation; the weight of the octave is one for which a cell and one of its equals in another octave, at most 32 away, differ by
/// 493 cells.
#[inline(always)]
pub(super) fn linear_word(words: [u32; 4]) -> u32 {
    weighted_sum(words, WEIGHTS)
}

/// Returns `lowbias32` of a word (C. Wellons, hash-prospector, 2018): two multiplications.
#[inline(always)]
pub(super) fn lowbias(word: u32) -> u32 {
    let h = (word ^ (word >> 16)).wrapping_mul(0x7feb_352d);
    let h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    h ^ (h >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each pair of coordinates with the only third, modulo 2^32, that makes a vector of the repeat.
    #[test]
    fn the_linear_word_repeats_after_1773_cells_and_not_before() {
        let [a, b, c, _] = WEIGHTS;
        // Newton's iteration for the inverse modulo 2^32: three bits are right at first, and each step doubles them.
        let inverse =
            (0..4).fold(c, |i, _| i.wrapping_mul(2_u32.wrapping_sub(c.wrapping_mul(i)))).wrapping_neg();
        assert_eq!(c.wrapping_mul(inverse), u32::MAX);
        let mut shortest = (i64::MAX, [0; 3]);
        for x in 0..=1773_i32 {
            let along_x = a.wrapping_mul(x as u32);
            for y in -1773..=1773_i32 {
                let z = along_x.wrapping_add(b.wrapping_mul(y as u32)).wrapping_mul(inverse) as i32;
                let square: i64 = [x, y, z].map(|c| i64::from(c) * i64::from(c)).iter().sum();
                if square > 0 {
                    shortest = shortest.min((square, [x, y, z]));
                }
            }
        }
        let square: i64 = LINEAR_REPEATS_AFTER.map(|c| i64::from(c) * i64::from(c)).iter().sum();
        assert_eq!(shortest, (square, LINEAR_REPEATS_AFTER));
        let [x, y, z] = LINEAR_REPEATS_AFTER.map(|c| c as u32);
        assert_eq!(linear_word([x, y, z, 0]), 0);
    }
}
