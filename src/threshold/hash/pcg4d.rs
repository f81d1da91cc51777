//! PCG4D of the words of a cell (Jarzynski & Olano 2020). Not in the paper.

use super::listed::Listed;
use super::words::integer_hash;

/// Returns PCG4D of four words (Jarzynski & Olano 2020).
#[inline(always)]
#[must_use]
pub fn pcg4d(words: [u32; 4]) -> [u32; 4] {
    let [mut x, mut y, mut z, mut w] = words.map(lcg);
    for round in 0..2 {
        x = x.wrapping_add(y.wrapping_mul(w));
        y = y.wrapping_add(z.wrapping_mul(x));
        z = z.wrapping_add(x.wrapping_mul(y));
        w = w.wrapping_add(y.wrapping_mul(z));
        if round == 0 {
            [x, y, z, w] = [x, y, z, w].map(|v| v ^ (v >> 16));
        }
    }
    [x, y, z, w]
}

#[inline(always)]
pub(super) fn lcg(word: u32) -> u32 {
    word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223)
}

integer_hash! {
    /// The first word of [`pcg4d`] over x, y, z and the octave.
    Pcg4d, |words| pcg4d(words)[0]
}

/// What the list of hashes says of it.
pub(crate) const ENTRY: Listed = Listed {
    name: "pcg4d",
    reads_octave: true,
    is_exact: true,
    repeats_after: None,
    #[cfg(feature = "shader")]
    wgsl: &[
        include_str!("../../shader/chunk/to_word.wgsl"),
        include_str!("../../shader/chunk/open_lattice.wgsl"),
        include_str!("../../shader/chunk/hash/pcg4d.wgsl"),
        include_str!("../../shader/chunk/hash_cell/pcg4d.wgsl"),
    ],
    #[cfg(feature = "gpu")]
    mistake: ["v.w += v.y * v.z", "v.w += v.y"],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// By a separate program.
    #[test]
    fn it_gives_its_published_bits() {
        for (words, expected) in [
            ([0, 0, 0, 0], [0x0f02_f829, 0x2d56_8769, 0x32b0_c43b, 0xd325_48ea]),
            ([1, 2, 3, 4], [0x3622_cd16, 0xf114_71d8, 0xe110_9b3f, 0x02b9_4c2f]),
            ([0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc], [0x8b61_361d, 0xd8f4_c5da, 0xd835_684a, 0x5859_ba25]),
            ([123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff], [0x6d93_d377, 0x641b_0b12, 0x9c59_738c, 0x8d2f_25cc]),
        ] {
            assert_eq!(pcg4d(words), expected, "{words:x?}");
        }
    }
}
