//! Hashes of a cell: from integral coordinates (and an octave) to a value that should look like a draw from U(0, 1).
//!
//! [`sine`] and [`sine_chi_2`] are the paper's own; of the others, those of integers are exact on every machine. Not all are sound:
//! some are here because shaders use them. [`offset`] makes independent hashes out of one. A hash is one file here, one chunk of WGSL
//! in `shader/chunk/hash_cell`, and one line of the list below.

mod cell;
mod listed;
pub mod offset;
mod reals;
mod words;

pub use super::choice::UnknownName;
pub use cell::{Cell, Hash, octave_word, open_lattice};

use super::choice::by_name;
use super::real::Real;
use core::fmt;
use core::str::FromStr;
pub(crate) use listed::Listed;
pub(in crate::threshold) use listed::OfBlocks;

/// Hands the list of hashes to a macro: kind, file and type of each, with what it is.
macro_rules! hashes {
    ($callback:ident) => {
        $callback! {
            Sine = sine, "The paper's `hash3D` (§5.1), also its chi_1 of §9.";
            SineChi2 = sine_chi_2, "The paper's second hash, chi_2 of §9.";
            Mm4 = mm4, "MurmurHash3 (x86, 32 bits) over x, y, z and the octave.";
            Xxhash32 = xxhash32, "XXH32 over x, y, z, seeded with the octave.";
            Pcg3d = pcg3d, "The first word of PCG3D over x, y, z; does not read the octave.";
            Pcg4d = pcg4d, "The first word of PCG4D over x, y, z and the octave.";
            PcgNested = pcg_nested, "The one-dimensional PCG, nested over the octave, z, y and x.";
            LowbiasLinear = lowbias_linear, "`lowbias32` of a sum of x, y, z and the octave with weights.";
            LowbiasNested = lowbias_nested, "`lowbias32`, nested over the octave, z, y and x.";
            TripleLinear = triple_linear, "`triple32` of a sum of x, y, z and the octave with weights.";
            MurmurNested = murmur_nested, "The end of MurmurHash3, nested over the octave, z, y and x.";
            WangNested = wang_nested, "Wang's 32-bit hash, nested over the octave, z, y and x.";
            EsgtsaNested = esgtsa_nested, "The hash of Schechter & Bridson, nested over the octave, z, y and x.";
            Wyhash32 = wyhash32, "wyhash for 32-bit machines over x, y, z and the octave.";
            Squirrel5 = squirrel5, "Squirrel noise, version 5, over x, y, z, seeded with the octave.";
            Tea3 = tea3, "Three rounds of TEA over x and y, mixed with z and the octave, and three more.";
            Iqint3 = iqint3, "Integer Hash III of Quilez over x, y, z and the octave.";
            OneAtATime = one_at_a_time, "Jenkins's one at a time over x, y, z and the octave.";
            Superfast = superfast, "SuperFastHash over x, y, z and the octave.";
            Fnv1a = fnv1a, "FNV-1a over x, y, z and the octave.";
            Teschner = teschner, "The spatial hash of Teschner et al. over x, y, z and the octave.";
            Weyl = weyl, "The additive recurrence R3 over x, y, z and the octave: a lattice.";
            Hoskins = hoskins, "Hoskins's hash without sine over x, y, z; does not read the octave.";
            InterleavedGradient = interleaved_gradient, "Interleaved gradient noise over x, y, z; does not read the octave.";
        }
    };
}
pub(crate) use hashes;

macro_rules! declare {
    ($($kind:ident = $file:ident, $doc:literal;)*) => {
        $(pub mod $file;)*

        /// The hashes that can be chosen by name.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum HashKind {
            $(#[doc = $doc] $kind,)*
        }

        impl HashKind {
            /// Every hash, in the order in which they are listed to users.
            pub const ALL: [Self; [$($doc),*].len()] = [$(Self::$kind),*];

            /// What the list says of it.
            pub(crate) const fn entry(self) -> &'static Listed {
                match self {
                    $(Self::$kind => &$file::ENTRY,)*
                }
            }

            /// What it is, in a sentence.
            #[must_use]
            pub const fn about(self) -> &'static str {
                match self {
                    $(Self::$kind => $doc,)*
                }
            }
        }

        impl<R: Real> Hash<R> for HashKind {
            fn hash(&self, cell: &Cell<R>) -> R {
                match self {
                    $(Self::$kind => $file::$kind.hash(cell),)*
                }
            }

            #[inline(always)]
            fn hash_all<const N: usize>(&self, cells: [Cell<R>; N]) -> [R; N] {
                match self {
                    $(Self::$kind => $file::$kind.hash_all(cells),)*
                }
            }
        }
    };
}
hashes!(declare);

impl HashKind {
    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.entry().name
    }

    /// Whether it is the same in every precision and on every machine.
    #[must_use]
    pub const fn is_exact(self) -> bool {
        self.entry().is_exact
    }

    /// Whether it reads the octave of a cell; if not, equal coordinates in two octaves have one value.
    #[must_use]
    pub const fn reads_octave(self) -> bool {
        self.entry().reads_octave
    }

    /// The shortest known vector of cells of one octave after which all its values are repeated: every hash that mixes a
    /// sum of indices with weights has one, of at most 1824 cells.
    #[must_use]
    pub const fn repeats_after(self) -> Option<[i32; 3]> {
        self.entry().repeats_after
    }
}

impl fmt::Display for HashKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
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
    fn names_lead_back_to_their_hash() {
        for kind in HashKind::ALL {
            assert_eq!(kind.name().parse(), Ok(kind));
        }
        let error = "sinus".parse::<HashKind>().unwrap_err();
        assert!(error.to_string().contains("mm4"), "{error}");
    }

    #[test]
    fn hashes_repeat_after_the_vector_that_they_state() {
        for kind in HashKind::ALL {
            let Some(vector) = kind.repeats_after() else { continue };
            for at in 0..100 {
                let index = [7 * at - 300, 31 - at * at, 11 * at];
                let of = |index: [i32; 3]| -> f64 {
                    kind.hash(&Cell { index: index.map(f64::from).into(), octave: 5 })
                };
                assert_eq!(
                    of(index),
                    of([0, 1, 2].map(|axis| index[axis] + vector[axis])),
                    "{kind} at {index:?}"
                );
            }
        }
    }

    #[test]
    fn both_precisions_give_the_same_value_of_integers() {
        let index = [-7.0, 1_234_567.0, 42.0];
        for kind in HashKind::ALL.into_iter().filter(|kind| kind.entry().is_exact) {
            let double: f64 = kind.hash(&Cell { index: index.into(), octave: 3 });
            let single: f32 = kind.hash(&Cell { index: index.map(|c| c as f32).into(), octave: 3 });
            assert_eq!(f64::from(single), double, "{kind}");
        }
    }
}
