//! `lowbias32` of a sum of the words of a cell. The mixer is by C. Wellons (hash-prospector, "Prospecting for Hash Functions",
//! 2018), the sum is ours. Not in the paper.

use super::listed::Listed;
use super::words::{LINEAR_REPEATS_AFTER, integer_hash, linear_word, lowbias};

integer_hash! {
    /// `lowbias32` of a sum of x, y, z and the octave, each with its weight.
    LowbiasLinear, |words| lowbias(linear_word(words))
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "lowbias-linear",
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
        include_str!("../../shader/chunk/hash/lowbias.wgsl"),
        include_str!("../../shader/chunk/hash_cell/lowbias_linear.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["0x846ca68bu", "0x846ca68du"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate computation in Python.
    #[test]
    fn it_gives_known_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x0000_0000),
            ([1, 2, 3, 4], 0x6b74_f164),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0x2d70_1f2f),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0x960b_1731),
        ] {
            assert_eq!(LowbiasLinear::word(words), expected, "{words:x?}");
        }
    }
}
