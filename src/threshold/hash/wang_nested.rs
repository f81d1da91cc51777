//! T. Wang's 32-bit integer hash (2007; in shaders after N. Reed, "Quick and Easy GPU Random Numbers", 2013), nested over the words
//! of a cell as in Jarzynski & Olano 2020. Not in the paper.

use super::listed::Listed;
use super::words::{integer_hash, nested};

/// Returns Wang's hash of a word, in the form with one large multiplication.
#[inline(always)]
#[must_use]
pub fn wang(word: u32) -> u32 {
    let h = (word ^ 61 ^ (word >> 16)).wrapping_mul(9);
    let h = (h ^ (h >> 4)).wrapping_mul(0x27d4_eb2d);
    h ^ (h >> 15)
}

integer_hash! {
    /// [`wang`] nested over the octave, z, y and x, each result added to the next word.
    WangNested, |words| nested(words, wang)
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "wang-nested",
    reads_octave: true,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/words.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash_cell/wang_nested.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["0x27d4eb2du", "0x27d4eb2fu"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate computation in Python.
    #[test]
    fn it_gives_known_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x18a4_d546),
            ([1, 2, 3, 4], 0x0e84_6e2c),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0x854a_9795),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0x5ce0_c2f9),
        ] {
            assert_eq!(WangNested::word(words), expected, "{words:x?}");
        }
    }
}
