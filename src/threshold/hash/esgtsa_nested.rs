//! The hash of Schechter & Bridson ("Evolving Sub-Grid Turbulence for Smoke Animation", 2008; `esgtsa` in Jarzynski & Olano 2020),
//! nested over the words of a cell. Not in the paper.

use super::listed::Listed;
use super::words::{integer_hash, nested};

/// Returns the hash of Schechter & Bridson of a word.
#[inline(always)]
#[must_use]
pub fn esgtsa(word: u32) -> u32 {
    let h = (word ^ 2_747_636_419).wrapping_mul(2_654_435_769);
    let h = (h ^ (h >> 16)).wrapping_mul(2_654_435_769);
    (h ^ (h >> 16)).wrapping_mul(2_654_435_769)
}

integer_hash! {
    /// [`esgtsa`] nested over the octave, z, y and x, each result added to the next word.
    EsgtsaNested, |words| nested(words, esgtsa)
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "esgtsa-nested",
    reads_octave: true,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/words.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash_cell/esgtsa_nested.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["2747636419u", "2747636421u"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate computation in Python.
    #[test]
    fn it_gives_known_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0xfd76_82bd),
            ([1, 2, 3, 4], 0xc473_084e),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0xf94e_c4bb),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0xe2a7_9405),
        ] {
            assert_eq!(EsgtsaNested::word(words), expected, "{words:x?}");
        }
    }
}
