//! `triple32` of a sum of the words of a cell. The mixer is by C. Wellons (hash-prospector, 2018), the sum is ours. Not in the
//! paper.

use super::listed::Listed;
use super::words::{LINEAR_REPEATS_AFTER, integer_hash, linear_word};

/// Returns `triple32` of a word: three multiplications, of a bias that its author found to be that of a random permutation.
#[inline(always)]
#[must_use]
pub fn triple(word: u32) -> u32 {
    let h = (word ^ (word >> 17)).wrapping_mul(0xed5a_d4bb);
    let h = (h ^ (h >> 11)).wrapping_mul(0xac4c_1b51);
    let h = (h ^ (h >> 15)).wrapping_mul(0x3184_8bab);
    h ^ (h >> 14)
}

integer_hash! {
    /// [`triple`] of a sum of x, y, z and the octave, each with its weight.
    TripleLinear, |words| triple(linear_word(words))
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "triple-linear",
    reads_octave: true,
    is_exact: true,
    repeats_after: Some(LINEAR_REPEATS_AFTER),
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/words.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash/weighted_sum.wgsl"),
        include_str!("../../shader/chunk/hash/linear_word.wgsl"),
        include_str!("../../shader/chunk/hash_cell/triple_linear.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["0x31848babu", "0x31848badu"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate computation in Python.
    #[test]
    fn it_gives_known_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x0000_0000),
            ([1, 2, 3, 4], 0xa8d7_ad79),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0x1659_ea1b),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0x044f_3be7),
        ] {
            assert_eq!(TripleLinear::word(words), expected, "{words:x?}");
        }
    }
}
