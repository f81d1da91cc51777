//! The end of MurmurHash3 (A. Appleby, 2011) as a mixer of one word, nested over the words of a cell. Nesting it is ours, and so is
//! that the length, 16, stays in: it moves the fixed point of the mixer away from 0. Not in the paper.

use super::listed::Listed;
use super::mm4::murmur_end;
use super::words::{integer_hash, nested};

integer_hash! {
    /// The end of MurmurHash3 nested over the octave, z, y and x, each result added to the next word.
    MurmurNested, |words| nested(words, murmur_end)
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "murmur-nested",
    reads_octave: true,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/words.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash/murmur_end.wgsl"),
        include_str!("../../shader/chunk/hash_cell/murmur_nested.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["0xc2b2ae35u", "0xc2b2ae37u"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate computation in Python.
    #[test]
    fn it_gives_known_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0xf6f7_524d),
            ([1, 2, 3, 4], 0xd149_9a6d),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0x0c23_0db4),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0x13aa_c454),
        ] {
            assert_eq!(MurmurNested::word(words), expected, "{words:x?}");
        }
    }
}
