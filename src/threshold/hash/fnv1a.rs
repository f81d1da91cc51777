//! FNV-1a (Fowler, Noll & Vo, 1991; 32 bits) over the words of a cell. The original goes over bytes; over whole words, as in shaders,
//! it takes a quarter of the steps, and neighbours share most of the upper bits. Not in the paper.

use super::listed::Listed;
use super::words::integer_hash;

#[inline(always)]
fn fnv_step(state: u32, unit: u32) -> u32 {
    (state ^ unit).wrapping_mul(16_777_619)
}

/// Returns the hash of units, bytes or words.
#[inline(always)]
#[must_use]
pub fn fnv_1a(units: impl IntoIterator<Item = u32>) -> u32 {
    units.into_iter().fold(2_166_136_261, fnv_step)
}

integer_hash! {
    /// [`fnv_1a`] over x, y, z and the octave.
    Fnv1a, |words| fnv_1a(words)
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "fnv1a",
    reads_octave: true,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/words.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash_cell/fnv1a.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["2166136261u", "2166136263u"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate computation in Python.
    #[test]
    fn it_gives_known_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x4b95_f515),
            ([1, 2, 3, 4], 0x5734_a87d),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0x91fc_3ff1),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0x436b_fde2),
        ] {
            assert_eq!(Fnv1a::word(words), expected, "{words:x?}");
        }
    }

    #[test]
    fn over_bytes_it_gives_its_published_bits() {
        let of = |text: &str| fnv_1a(text.bytes().map(u32::from));
        assert_eq!(of("a"), 0xe40c_292c);
        assert_eq!(of("foobar"), 0xbf9c_f968);
    }
}
