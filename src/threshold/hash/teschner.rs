//! The spatial hash of Teschner et al., "Optimized Spatial Hashing for Collision Detection of Deformable Objects", VMV 2003: coordinates
//! times numbers that the paper calls primes (19349663 is 41 times 471943), exclusive or. It was made for the lower bits, those of a table's index; a threshold has the upper ones. The
//! octave times the prime next to 2^32 over the golden ratio (Knuth) is ours. Not in the paper.

use super::listed::Listed;
use super::words::integer_hash;

/// Returns the spatial hash of the words of a cell.
#[inline(always)]
#[must_use]
pub fn spatial([x, y, z, octave]: [u32; 4]) -> u32 {
    let place = x.wrapping_mul(73_856_093) ^ y.wrapping_mul(19_349_663) ^ z.wrapping_mul(83_492_791);
    place ^ octave.wrapping_mul(2_654_435_761)
}

integer_hash! {
    /// [`spatial`] over x, y, z and the octave.
    Teschner, |words| spatial(words)
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "teschner",
    reads_octave: true,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/words.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash_cell/teschner.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["83492791u", "83492793u"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate computation in Python.
    #[test]
    fn it_gives_known_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x0000_0000),
            ([1, 2, 3, 4], 0x7018_6c82),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0x7018_6c86),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0x19a1_4701),
        ] {
            assert_eq!(Teschner::word(words), expected, "{words:x?}");
        }
    }
}
