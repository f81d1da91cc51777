//! Squirrel noise, version 5, of the words of a cell (S. Eiserloh, "Noise-Based RNG", GDC 2017; version 5, 2021). The sum of the
//! coordinates and its primes are his, too: its shortest repeat, of cells in one octave, is (418, -263, -555). Not in the paper.

use super::listed::Listed;
use super::words::{integer_hash, weighted_sum};

/// Returns the noise at a position, with a seed.
#[inline(always)]
#[must_use]
pub fn squirrel(position: u32, seed: u32) -> u32 {
    let h = position.wrapping_mul(0xd2a8_0a3f).wrapping_add(seed);
    let h = (h ^ (h >> 9)).wrapping_add(0xa884_f197);
    let h = (h ^ (h >> 11)).wrapping_mul(0x6c73_6f4b);
    let h = (h ^ (h >> 13)).wrapping_add(0xb79f_3abb);
    let h = (h ^ (h >> 15)).wrapping_mul(0x1b56_c4f5);
    h ^ (h >> 17)
}

integer_hash! {
    /// [`squirrel`] at x + 198491317 y + 6542989 z, seeded with the octave.
    Squirrel5, |[x, y, z, octave]| {
        let position = weighted_sum([x, y, z, 0], [1, 198_491_317, 6_542_989, 0]);
        squirrel(position, octave)
    }
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "squirrel5",
    reads_octave: true,
    is_exact: true,
    repeats_after: Some([418, -263, -555]),
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/words.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash_cell/squirrel5.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["0x6c736f4bu", "0x6c736f4du"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate computation in Python.
    #[test]
    fn it_gives_known_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x1679_1e00),
            ([1, 2, 3, 4], 0x737b_b931),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0x6bc9_dea8),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0xb83a_49e1),
        ] {
            assert_eq!(Squirrel5::word(words), expected, "{words:x?}");
        }
    }
}
