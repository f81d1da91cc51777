//! "Integer Hash III" (I. Quilez, 2017; `iqint3` in Jarzynski & Olano 2020) of pairs of words, and of the two results, which is
//! ours: it was made for the two coordinates of a pixel. Not in the paper.

use super::listed::Listed;
use super::words::integer_hash;

/// Returns the hash of two words.
#[inline(always)]
#[must_use]
pub fn iqint([x, y]: [u32; 2]) -> u32 {
    const FACTOR: u32 = 1_103_515_245;
    let first = ((x >> 1) ^ y).wrapping_mul(FACTOR);
    let second = ((y >> 1) ^ x).wrapping_mul(FACTOR);
    (first ^ (second >> 3)).wrapping_mul(FACTOR)
}

integer_hash! {
    /// [`iqint`] of that of x and y and of that of z and the octave.
    Iqint3, |[x, y, z, octave]| iqint([iqint([x, y]), iqint([z, octave])])
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "iqint3",
    reads_octave: true,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/words.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash_cell/iqint3.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: [">> 3u", ">> 4u"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate computation in Python.
    #[test]
    fn it_gives_known_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x0000_0000),
            ([1, 2, 3, 4], 0xa963_7f36),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0x85c1_96a1),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0xe9bb_a3a7),
        ] {
            assert_eq!(Iqint3::word(words), expected, "{words:x?}");
        }
    }
}
