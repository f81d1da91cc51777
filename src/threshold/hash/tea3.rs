//! Three rounds of the Tiny Encryption Algorithm (Wheeler & Needham, 1994), as a hash and with the key of Zafar, Olano & Curtis,
//! "GPU Random Numbers via the Tiny Encryption Algorithm", HPG 2010. It takes two words; that the other two are mixed into what comes
//! out, and enciphered again, is ours. Not in the paper.

use super::listed::Listed;
use super::words::integer_hash;

/// Enciphers two words in three rounds.
#[inline(always)]
#[must_use]
pub fn tea([mut a, mut b]: [u32; 2]) -> [u32; 2] {
    let half = |word: u32, sum: u32, [first, second]: [u32; 2]| {
        (word << 4).wrapping_add(first) ^ word.wrapping_add(sum) ^ (word >> 5).wrapping_add(second)
    };
    for round in 1..4_u32 {
        let sum = round.wrapping_mul(0x9e37_79b9);
        a = a.wrapping_add(half(b, sum, [0xa341_316c, 0xc801_3ea4]));
        b = b.wrapping_add(half(a, sum, [0xad90_777d, 0x7e95_761e]));
    }
    [a, b]
}

integer_hash! {
    /// The first word of [`tea`] over z and the octave, each mixed with a word of [`tea`] over x and y.
    Tea3, |[x, y, z, octave]| {
        let [a, b] = tea([x, y]);
        tea([a ^ z, b ^ octave])[0]
    }
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "tea3",
    reads_octave: true,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/words.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash_cell/tea3.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["0xc8013ea4u", "0xc8013ea6u"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate computation in Python, which gives the published block of all 32 rounds, 0x41ea3a0a and 0x94baa940 of zeros.
    #[test]
    fn it_gives_known_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x9b26_4a77),
            ([1, 2, 3, 4], 0xe644_24b0),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0xc54c_f60f),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0x9407_d2fc),
        ] {
            assert_eq!(Tea3::word(words), expected, "{words:x?}");
        }
    }
}
