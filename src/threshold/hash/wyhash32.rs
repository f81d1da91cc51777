//! wyhash for 32-bit machines (Wang Yi, 2019) of the words of a cell: "mum", a product of two words folded upon itself (V. Makarov,
//! 2016). Not in the paper.

use super::listed::Listed;
use super::words::integer_hash;

/// Returns the lower and the upper half of a product.
#[inline(always)]
fn product_of(a: u32, b: u32) -> [u32; 2] {
    let product = u64::from(a) * u64::from(b);
    [product as u32, (product >> 32) as u32]
}

#[inline(always)]
fn wymix([a, b]: [u32; 2]) -> [u32; 2] {
    product_of(a ^ 0x53c5_ca59, b ^ 0x7474_3c1b)
}

/// Returns the hash of four little-endian words, seed 0.
#[inline(always)]
#[must_use]
pub fn wyhash([x, y, z, w]: [u32; 4]) -> u32 {
    // The seed and the length in bytes.
    let [a, b] = wymix([0, 16]);
    let [a, b] = wymix([a ^ x, b ^ y]);
    let [a, b] = wymix(wymix([a ^ z, b ^ w]));
    a ^ b
}

integer_hash! {
    /// [`wyhash`] over x, y, z and the octave.
    Wyhash32, |words| wyhash(words)
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "wyhash32",
    reads_octave: true,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/words.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash_cell/wyhash32.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["0x53c5ca59u", "0x53c5ca5bu"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate program in Python, whose verification code is that of SMHasher, 0x09de8066.
    #[test]
    fn it_gives_known_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], 0x2d92_fc3e),
            ([1, 2, 3, 4], 0x854a_5f56),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], 0x4ff4_4d03),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], 0x7782_3f95),
        ] {
            assert_eq!(Wyhash32::word(words), expected, "{words:x?}");
        }
    }
}
