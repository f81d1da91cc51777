//! MurmurHash3 (x86, 32 bits) of the words of a cell. By A. Appleby; in shaders after Jarzynski & Olano, "Hash Functions for
//! GPU Rendering", JCGT 9(3), 2020. Not in the paper.

use super::listed::Listed;
use super::words::integer_hash;

/// Mixes a word into the state of MurmurHash3.
#[inline(always)]
fn murmur_step(state: u32, word: u32) -> u32 {
    let mixed = state ^ word.wrapping_mul(0xcc9e_2d51).rotate_left(15).wrapping_mul(0x1b87_3593);
    mixed.rotate_left(13).wrapping_mul(5).wrapping_add(0xe654_6b64)
}

/// Ends MurmurHash3 over four words.
#[inline(always)]
pub(super) fn murmur_end(state: u32) -> u32 {
    let h = state ^ 16;
    let h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    let h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    h ^ (h >> 16)
}

/// Returns MurmurHash3 (x86, 32 bits, seed 0) of four little-endian words.
#[inline(always)]
#[must_use]
pub fn murmur3(words: [u32; 4]) -> u32 {
    murmur_end(words.into_iter().fold(0, murmur_step))
}

integer_hash! {
    /// [`murmur3`] over x, y, z and the octave.
    Mm4, |words| murmur3(words)
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "mm4",
    reads_octave: true,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/rotated_left.wgsl"),
        include_str!("../../shader/chunk/hash/murmur.wgsl"),
        include_str!("../../shader/chunk/hash/murmur_end.wgsl"),
        include_str!("../../shader/chunk/hash_cell/mm4.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["0x85ebca6bu", "0x85ebca6du"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By the Python package `mmh3`.
    #[test]
    fn it_gives_its_published_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x8134_cdf8),
            ([1, 2, 3, 4], 0x4445_ad00),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0xf8b9_bb56),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0xfb97_eb3a),
        ] {
            assert_eq!(murmur3(words), expected, "{words:x?}");
        }
    }
}
