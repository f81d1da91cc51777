//! XXH32 of the words of a cell. By Y. Collet; in shaders after Jarzynski & Olano 2020. Not in the paper.

use super::listed::Listed;
use super::words::integer_hash;

#[inline(always)]
fn xxhash_step(state: u32, word: u32) -> u32 {
    state.wrapping_add(word.wrapping_mul(3_266_489_917)).rotate_left(17).wrapping_mul(668_265_263)
}

/// Returns XXH32 of three little-endian words with a seed.
#[inline(always)]
#[must_use]
pub fn xxhash32(words: [u32; 3], seed: u32) -> u32 {
    let h = words.into_iter().fold(seed.wrapping_add(374_761_393).wrapping_add(12), xxhash_step);
    let h = (h ^ (h >> 15)).wrapping_mul(2_246_822_519);
    let h = (h ^ (h >> 13)).wrapping_mul(3_266_489_917);
    h ^ (h >> 16)
}

integer_hash! {
    /// [`xxhash32`] over x, y, z, seeded with the octave.
    Xxhash32, |[x, y, z, octave]| xxhash32([x, y, z], octave)
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "xxhash32",
    reads_octave: true,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/rotated_left.wgsl"),
        include_str!("../../shader/chunk/hash_cell/xxhash32.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["668265263u", "668265265u"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By the Python package `xxhash`.
    #[test]
    fn it_gives_its_published_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x31b8_da82),
            ([1, 2, 3, 4], 0x43ce_d5a5),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0xfa5e_d526),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0x2f02_0d45),
        ] {
            assert_eq!(xxhash32([words[0], words[1], words[2]], words[3]), expected, "{words:x?}");
        }
    }
}
