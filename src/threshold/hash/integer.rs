//! Integer hashes: the same bits on every machine and in every shading language.
//!
//! None is in the paper, which says that its hash matters less than the properties of that hash (§5.1). The PCG
//! family and the use of XXH32 and MurmurHash3 in shaders follow Jarzynski & Olano, "Hash Functions for GPU
//! Rendering", JCGT 9(3), 2020. Each reads the words of [`Cell::words`] and returns a value of [`open_lattice`].

use super::{Cell, Hash, open_lattice};
use crate::threshold::real::Real;

/// Returns MurmurHash3 (x86, 32 bits, seed 0) of four little-endian words.
#[inline(always)]
#[must_use]
pub fn murmur3(words: [u32; 4]) -> u32 {
    let mut h = 0_u32;
    for word in words {
        h ^= word.wrapping_mul(0xcc9e_2d51).rotate_left(15).wrapping_mul(0x1b87_3593);
        h = h.rotate_left(13).wrapping_mul(5).wrapping_add(0xe654_6b64);
    }
    h ^= 16;
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    h ^ (h >> 16)
}

/// Returns XXH32 of three little-endian words with a seed.
#[inline(always)]
#[must_use]
pub fn xxhash32(words: [u32; 3], seed: u32) -> u32 {
    let mut h = seed.wrapping_add(374_761_393).wrapping_add(12);
    for word in words {
        h = h.wrapping_add(word.wrapping_mul(3_266_489_917)).rotate_left(17).wrapping_mul(668_265_263);
    }
    h = (h ^ (h >> 15)).wrapping_mul(2_246_822_519);
    h = (h ^ (h >> 13)).wrapping_mul(3_266_489_917);
    h ^ (h >> 16)
}

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

/// Returns the one-dimensional PCG hash of a word (RXS-M-XS; Jarzynski & Olano 2020).
#[inline(always)]
#[must_use]
pub fn pcg(word: u32) -> u32 {
    let state = word.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let mixed = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (mixed >> 22) ^ mixed
}

#[inline(always)]
fn lcg(word: u32) -> u32 {
    word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223)
}

/// Declares a unit struct that hashes the words of a cell.
macro_rules! integer_hash {
    ($(#[$doc:meta])* $name:ident, |$words:pat_param| $value:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default)]
        pub struct $name;

        impl $name {
            /// Hashes the words of a cell to one.
            #[inline(always)]
            pub(in crate::threshold) fn word($words: [u32; 4]) -> u32 {
                $value
            }
        }

        impl<R: Real> Hash<R> for $name {
            fn hash(&self, cell: &Cell<R>) -> R {
                open_lattice(Self::word(cell.words()))
            }
        }
    };
}

integer_hash! {
    /// [`murmur3`] over x, y, z and the octave.
    Mm4, |words| murmur3(words)
}
integer_hash! {
    /// [`xxhash32`] over x, y, z, seeded with the octave.
    Xxhash32, |[x, y, z, octave]| xxhash32([x, y, z], octave)
}
integer_hash! {
    /// The first word of [`pcg3d`] over x, y, z; does not read the octave.
    Pcg3d, |[x, y, z, _]| pcg3d([x, y, z])[0]
}
integer_hash! {
    /// The first word of [`pcg4d`] over x, y, z and the octave.
    Pcg4d, |words| pcg4d(words)[0]
}
integer_hash! {
    /// [`pcg`] nested over the octave, z, y and x, each result added to the next word.
    PcgNested, |[x, y, z, octave]| [octave, z, y, x].into_iter().fold(0, |h, word| pcg(h.wrapping_add(word)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One input and what the six hashes make of it: MurmurHash3 and XXH32 by the Python packages `mmh3` and
    /// `xxhash`, the PCG family by a separate program.
    struct Golden {
        words: [u32; 4],
        murmur3: u32,
        xxhash32: u32,
        pcg3d: [u32; 3],
        pcg4d: [u32; 4],
        pcg_nested: u32,
    }

    const GOLDEN: [Golden; 4] = [
        Golden {
            words: [0, 0, 0, 0],
            murmur3: 0x8134_cdf8,
            xxhash32: 0x31b8_da82,
            pcg3d: [0x9baf_d7c6, 0xa8e8_8a6b, 0x3f15_482c],
            pcg4d: [0x0f02_f829, 0x2d56_8769, 0x32b0_c43b, 0xd325_48ea],
            pcg_nested: 0x8d32_4821,
        },
        Golden {
            words: [1, 2, 3, 4],
            murmur3: 0x4445_ad00,
            xxhash32: 0x43ce_d5a5,
            pcg3d: [0xfa9f_79a6, 0x48f2_f44c, 0x596f_5ab1],
            pcg4d: [0x3622_cd16, 0xf114_71d8, 0xe110_9b3f, 0x02b9_4c2f],
            pcg_nested: 0xade9_6895,
        },
        Golden {
            words: [0xffff_ffff, 0xffff_fffe, 0xffff_fffd, 0xffff_fffc],
            murmur3: 0xf8b9_bb56,
            xxhash32: 0xfa5e_d526,
            pcg3d: [0x95bf_e42a, 0x844d_c605, 0xd1df_cd81],
            pcg4d: [0x8b61_361d, 0xd8f4_c5da, 0xd835_684a, 0x5859_ba25],
            pcg_nested: 0xb705_c4bc,
        },
        Golden {
            words: [123_456_789, 987_654_321, 0x8000_0000, 0xffff_ffff],
            murmur3: 0xfb97_eb3a,
            xxhash32: 0x2f02_0d45,
            pcg3d: [0xde78_2355, 0x1437_d41f, 0xada3_f3b8],
            pcg4d: [0x6d93_d377, 0x641b_0b12, 0x9c59_738c, 0x8d2f_25cc],
            pcg_nested: 0xcb3b_75d2,
        },
    ];

    #[test]
    fn every_hash_gives_its_published_bits() {
        for golden in GOLDEN {
            let [x, y, z, octave] = golden.words;
            assert_eq!(murmur3(golden.words), golden.murmur3, "murmur3 {:x?}", golden.words);
            assert_eq!(xxhash32([x, y, z], octave), golden.xxhash32, "xxhash32 {:x?}", golden.words);
            assert_eq!(pcg3d([x, y, z]), golden.pcg3d, "pcg3d {:x?}", golden.words);
            assert_eq!(pcg4d(golden.words), golden.pcg4d, "pcg4d {:x?}", golden.words);
            let index = [x, y, z].map(|word| f64::from(word as i32));
            let cell = Cell { index: index.into(), octave };
            let nested: f64 = PcgNested.hash(&cell);
            assert_eq!(nested, open_lattice::<f64>(golden.pcg_nested), "pcg_nested {:x?}", golden.words);
        }
    }

    #[test]
    fn both_precisions_give_the_same_value() {
        let index = [-7.0, 1_234_567.0, 42.0];
        for kind in super::super::HashKind::ALL.into_iter().skip(2) {
            let double: f64 = kind.hash(&Cell { index: index.into(), octave: 3 });
            let single: f32 = kind.hash(&Cell { index: index.map(|c| c as f32).into(), octave: 3 });
            assert_eq!(f64::from(single), double, "{kind}");
        }
    }
}
