//! Hashes of a cell: from integral coordinates (and an octave) to a value that should look like a draw from U(0, 1).
//!
//! [`sine`] is the paper's own; [`integer`] holds hashes that are exact on every machine; [`offset`] makes
//! independent hashes out of one.

pub mod integer;
pub mod offset;
pub mod sine;

use super::real::Real;
use core::fmt;
use core::str::FromStr;

/// One cell of the grid that cuts space at one scale (a *voxel* in the paper's Fig. 6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell<R: Real> {
    /// Integral coordinates, each counted in cells of its own axis.
    pub index: R::Vec3,
    /// The octave as one word, see [`octave_word`]. The paper's hash does not read it.
    pub octave: u32,
}

impl<R: Real> Cell<R> {
    /// Returns x, y, z as the low 32 bits of their two's complement, and the octave.
    ///
    /// Distinct cells give distinct words as long as each coordinate is in [-2^31, 2^31).
    #[must_use]
    pub fn words(&self) -> [u32; 4] {
        let [x, y, z] = self.index.into();
        [x.to_word(), y.to_word(), z.to_word(), self.octave]
    }
}

/// Packs the octave of each axis into one word.
///
/// Equal octaves give that octave in two's complement, so a cubic cell of the anisotropic grid is the cell of the
/// isotropic one. Injective while every octave is in (-1024, 1024) and two of them differ by less than 512. Not in
/// the paper.
#[inline(always)]
#[must_use]
pub fn octave_word([x, y, z]: [i32; 3]) -> u32 {
    let word =
        x.wrapping_add(y.wrapping_sub(x).wrapping_shl(11)).wrapping_add(z.wrapping_sub(x).wrapping_shl(21));
    word as u32
}

/// Maps a word to the open lattice: (2k + 1) / 2^24 where k holds the upper 23 bits.
///
/// The value is in [2^-24, 1 - 2^-24], exact in `f32` and `f64`, symmetric about 1/2, never 0 and never 1. Not in
/// the paper, whose hash takes 0 with a probability of 4e-4 in `f32`.
#[must_use]
pub fn open_lattice<R: Real>(word: u32) -> R {
    R::from_f64(f64::from(2 * (word >> 9) + 1) * (1.0 / 16_777_216.0))
}

/// A hash of cells. Implement it to put a hash of your own on trial.
///
/// ```
/// use hashed_alpha::threshold::{hash::{Cell, Hash, open_lattice}, real::Real};
///
/// struct Weak;
/// impl<R: Real> Hash<R> for Weak {
///     fn hash(&self, cell: &Cell<R>) -> R {
///         let [x, y, z, octave] = cell.words();
///         open_lattice((x ^ y.rotate_left(8) ^ z.rotate_left(16) ^ octave).wrapping_mul(0x9e37_79b9))
///     }
/// }
/// ```
pub trait Hash<R: Real>: Sync {
    /// Returns the value of `cell`; the paper asks for a uniform law on [0, 1) (§5).
    fn hash(&self, cell: &Cell<R>) -> R;
}

/// The hashes that can be chosen by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HashKind {
    /// The paper's `hash3D` (§5.1), also its chi_1 of §9.
    Sine,
    /// The paper's second hash, chi_2 of §9.
    SineChi2,
    /// MurmurHash3 (x86, 32 bits) over x, y, z and the octave.
    Mm4,
    /// XXH32 over x, y, z, seeded with the octave.
    Xxhash32,
    /// The first word of PCG3D over x, y, z; does not read the octave.
    Pcg3d,
    /// The first word of PCG4D over x, y, z and the octave.
    Pcg4d,
    /// The one-dimensional PCG, nested over the octave, z, y and x.
    PcgNested,
}

impl HashKind {
    /// Every hash, in the order in which they are listed to users.
    pub const ALL: [Self; 7] =
        [Self::Sine, Self::SineChi2, Self::Mm4, Self::Xxhash32, Self::Pcg3d, Self::Pcg4d, Self::PcgNested];

    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sine => "sine",
            Self::SineChi2 => "sine-chi2",
            Self::Mm4 => "mm4",
            Self::Xxhash32 => "xxhash32",
            Self::Pcg3d => "pcg3d",
            Self::Pcg4d => "pcg4d",
            Self::PcgNested => "pcg-nested",
        }
    }
}

impl<R: Real> Hash<R> for HashKind {
    fn hash(&self, cell: &Cell<R>) -> R {
        match self {
            Self::Sine => sine::Sine.hash(cell),
            Self::SineChi2 => sine::SineChi2.hash(cell),
            Self::Mm4 => integer::Mm4.hash(cell),
            Self::Xxhash32 => integer::Xxhash32.hash(cell),
            Self::Pcg3d => integer::Pcg3d.hash(cell),
            Self::Pcg4d => integer::Pcg4d.hash(cell),
            Self::PcgNested => integer::PcgNested.hash(cell),
        }
    }
}

impl fmt::Display for HashKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A name that belongs to none of the things that can be chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownName {
    /// What was to be chosen, as in "hash".
    pub what: &'static str,
    /// The name that was given.
    pub name: String,
    /// The names that would do, separated by commas.
    pub known: String,
}

impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, name, known } = self;
        write!(f, "unknown {what} `{name}`; known are {known}")
    }
}

impl core::error::Error for UnknownName {}

/// Finds the member of `all` whose `name` was given.
pub(crate) fn by_name<T: Copy>(
    what: &'static str,
    all: &[T],
    name_of: fn(T) -> &'static str,
    name: &str,
) -> Result<T, UnknownName> {
    all.iter().copied().find(|&item| name_of(item) == name).ok_or_else(|| UnknownName {
        what,
        name: name.to_owned(),
        known: all.iter().map(|&item| name_of(item)).collect::<Vec<_>>().join(", "),
    })
}

impl FromStr for HashKind {
    type Err = UnknownName;
    fn from_str(name: &str) -> Result<Self, UnknownName> {
        by_name("hash", &Self::ALL, Self::name, name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn open_lattice_is_symmetric_and_never_zero_or_one() {
        for word in [0, 1, 511, 512, 0x7fff_ffff, 0x8000_0000, u32::MAX] {
            let (value, mirrored) = (open_lattice::<f64>(word), open_lattice::<f64>(!word));
            assert!(value > 0.0 && value < 1.0);
            assert_eq!(value + mirrored, 1.0);
            assert_eq!(f64::from(open_lattice::<f32>(word)), value);
        }
        assert_eq!(open_lattice::<f64>(0), 1.0 / 16_777_216.0);
    }

    #[test]
    fn octave_word_tells_octaves_apart_and_keeps_equal_ones() {
        let mut seen = std::collections::HashSet::new();
        for x in (-140..=120).step_by(13) {
            assert_eq!(octave_word([x; 3]), x as u32);
            for y in (-140..=120).step_by(13) {
                for z in (-140..=120).step_by(13) {
                    assert!(seen.insert(octave_word([x, y, z])), "{x} {y} {z}");
                }
            }
        }
    }

    #[test]
    fn names_lead_back_to_their_hash() {
        for kind in HashKind::ALL {
            assert_eq!(kind.name().parse(), Ok(kind));
        }
        let error = "sinus".parse::<HashKind>().unwrap_err();
        assert!(error.to_string().contains("mm4"), "{error}");
    }

    #[test]
    fn words_are_twos_complement() {
        let cell = Cell::<f32> { index: glam::vec3(-1.0, 3.0e9, 2.0), octave: 7 };
        assert_eq!(cell.words(), [u32::MAX, 3_000_000_000, 2, 7]);
    }
}
