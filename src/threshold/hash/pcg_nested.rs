//! The one-dimensional PCG, nested over the words of a cell (Jarzynski & Olano 2020). Not in the paper.

use super::listed::Listed;
use super::words::{integer_hash, nested};

/// Returns the one-dimensional PCG hash of a word (RXS-M-XS; Jarzynski & Olano 2020).
#[inline(always)]
#[must_use]
pub fn pcg(word: u32) -> u32 {
    let state = word.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let mixed = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (mixed >> 22) ^ mixed
}

integer_hash! {
    /// [`pcg`] nested over the octave, z, y and x, each result added to the next word.
    PcgNested, |words| nested(words, pcg)
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "pcg-nested",
    reads_octave: true,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash/pcg.wgsl"),
        include_str!("../../shader/chunk/hash_cell/pcg_nested.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: [">> 28u", ">> 27u"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate program.
    #[test]
    fn it_gives_its_published_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x8d32_4821),
            ([1, 2, 3, 4], 0xade9_6895),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0xb705_c4bc),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0xcb3b_75d2),
        ] {
            assert_eq!(PcgNested::word(words), expected, "{words:x?}");
        }
    }
}
