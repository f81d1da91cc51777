//! `lowbias32` (C. Wellons, hash-prospector, 2018), nested over the words of a cell as Jarzynski & Olano 2020 nest others. Not in
//! the paper.

use super::listed::Listed;
use super::words::{integer_hash, lowbias, nested};

integer_hash! {
    /// `lowbias32` nested over the octave, z, y and x, each result added to the next word.
    LowbiasNested, |words| nested(words, lowbias)
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "lowbias-nested",
    reads_octave: true,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/words.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash/lowbias.wgsl"),
        include_str!("../../shader/chunk/hash_cell/lowbias_nested.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["0x846ca68bu", "0x846ca68du"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate computation in Python.
    #[test]
    fn it_gives_known_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x0000_0000),
            ([1, 2, 3, 4], 0x115e_1f84),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0x8754_a896),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0x34a3_5804),
        ] {
            assert_eq!(LowbiasNested::word(words), expected, "{words:x?}");
        }
    }
}
