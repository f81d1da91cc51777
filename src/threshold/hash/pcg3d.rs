//! PCG3D of the coordinates of a cell (Jarzynski & Olano 2020). Not in the paper.

use super::listed::Listed;
use super::pcg4d::lcg;
use super::words::integer_hash;

/// Returns PCG3D of three words (Jarzynski & Olano 2020).
#[inline(always)]
#[must_use]
pub fn pcg3d(words: [u32; 3]) -> [u32; 3] {
    let [mut x, mut y, mut z] = words.map(lcg);
    for round in 0..2 {
        x = x.wrapping_add(y.wrapping_mul(z));
        y = y.wrapping_add(z.wrapping_mul(x));
        z = z.wrapping_add(x.wrapping_mul(y));
        if round == 0 {
            [x, y, z] = [x, y, z].map(|v| v ^ (v >> 16));
        }
    }
    [x, y, z]
}

integer_hash! {
    /// The first word of [`pcg3d`] over x, y, z; does not read the octave.
    Pcg3d, |[x, y, z, _]| pcg3d([x, y, z])[0]
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "pcg3d",
    reads_octave: false,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash_cell/pcg3d.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["v.z += v.x * v.y", "v.z += v.x"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate program.
    #[test]
    fn it_gives_its_published_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], [0x9baf_d7c6, 0xa8e8_8a6b, 0x3f15_482c]),
            ([1, 2, 3, 4], [0xfa9f_79a6, 0x48f2_f44c, 0x596f_5ab1]),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], [0x95bf_e42a, 0x844d_c605, 0xd1df_cd81]),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], [0xde78_2355, 0x1437_d41f, 0xada3_f3b8]),
        ] {
            assert_eq!(pcg3d([words[0], words[1], words[2]]), expected, "{words:x?}");
        }
    }
}
