//! SuperFastHash (P. Hsieh, 2004; `superfast` in Jarzynski & Olano 2020) over the words of a cell: shifts and sums, no multiplication.
//! Not in the paper.

use super::listed::Listed;
use super::words::integer_hash;

#[inline(always)]
fn superfast_step(state: u32, word: u32) -> u32 {
    let h = state.wrapping_add(word & 0xffff);
    let h = (h << 16) ^ ((word >> 16) << 11) ^ h;
    h.wrapping_add(h >> 11)
}

#[inline(always)]
fn superfast_end(state: u32) -> u32 {
    let h = state ^ (state << 3);
    let h = h.wrapping_add(h >> 5);
    let h = h ^ (h << 4);
    let h = h.wrapping_add(h >> 17);
    let h = h ^ (h << 25);
    h.wrapping_add(h >> 6)
}

integer_hash! {
    /// SuperFastHash over x, y, z and the octave, as 16 little-endian bytes.
    Superfast, |words| superfast_end(words.into_iter().fold(16, superfast_step))
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "superfast",
    reads_octave: true,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/words.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash_cell/superfast.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["<< 25u", "<< 24u"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate computation in Python.
    #[test]
    fn it_gives_known_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x8154_70d6),
            ([1, 2, 3, 4], 0xc4dc_1ae6),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0xe4d8_5636),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0x02cd_2f6b),
        ] {
            assert_eq!(Superfast::word(words), expected, "{words:x?}");
        }
    }
}
