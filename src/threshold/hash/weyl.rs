//! The additive recurrence R3 as a lattice: the words of a cell times irrational numbers, modulo 1. After H. Weyl; the numbers are those
//! of M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences" (2018), 1/g, 1/g^2, 1/g^3 with g^4 = g + 1, as nearest odd
//! multiples of 2^-32; the octave has the golden ratio, which is ours. A regular pattern: it is here as what no claim of
//! independence may accept. Not in the paper.

use super::listed::Listed;
use super::words::{integer_hash, weighted_sum};

integer_hash! {
    /// The sum of x, y, z and the octave, each times its number.
    Weyl, |words| weighted_sum(words, [3_518_319_155, 2_882_110_345, 2_360_945_575, 2_654_435_769])
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "weyl",
    reads_octave: true,
    is_exact: true,
    repeats_after: Some([849, 1009, -132]),
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/words.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash/weighted_sum.wgsl"),
        include_str!("../../shader/chunk/hash_cell/weyl.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["2882110345u", "2882110347u"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate computation in Python.
    #[test]
    fn it_gives_known_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x0000_0000),
            ([1, 2, 3, 4], 0x4851_bb1e),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0xb7ae_44e2),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0xc5c5_0d2f),
        ] {
            assert_eq!(Weyl::word(words), expected, "{words:x?}");
        }
    }

    #[test]
    fn its_numbers_are_the_powers_of_the_root() {
        let g = 1.220_744_084_605_759_5_f64;
        assert!((g.powi(4) - g - 1.0).abs() < 1e-15);
        for (power, word) in [(1, 3_518_319_155_u32), (2, 2_882_110_345), (3, 2_360_945_575)] {
            assert!((g.powi(-power) * 4_294_967_296.0 - f64::from(word)).abs() <= 1.0, "{power}");
        }
    }
}
