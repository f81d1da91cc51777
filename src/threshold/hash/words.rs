//! What hashes of words have in common: the same bits on every machine and in every shading language.
//!
//! None is in the paper, which says that its hash matters less than the properties of that hash (§5.1). Each reads the words
//! of [`Cell::words`](super::Cell::words) and returns a value of [`open_lattice`](super::open_lattice).

/// Declares a unit struct that hashes the words of a cell.
macro_rules! integer_hash {
    ($(#[$doc:meta])* $name:ident, |$words:pat_param| $value:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default)]
        pub struct $name;

        impl $name {
            /// Hashes the words of a cell to one.
            #[inline(always)]
            fn word($words: [u32; 4]) -> u32 {
                $value
            }
        }

        impl<R: $crate::threshold::real::Real> $crate::threshold::hash::cell::Hash<R> for $name {
            #[inline(always)]
            fn hash(&self, cell: &$crate::threshold::hash::cell::Cell<R>) -> R {
                $crate::threshold::hash::cell::open_lattice(Self::word(cell.words()))
            }
        }

        impl $crate::threshold::hash::listed::OfBlocks for $name {
            #[inline(always)]
            fn block<R: $crate::threshold::batch::lane::Kernel, const FUSED: bool>(
                _: impl Fn(R) -> R + Copy,
                [x, y, z]: [&$crate::threshold::batch::block::Block<R>; 3],
                octave: &$crate::threshold::batch::block::Block<u32>,
                out: &mut $crate::threshold::batch::block::Block<R>,
            ) {
                for i in 0..out.len() {
                    out[i] = R::lattice(Self::word([x[i].small_word(), y[i].small_word(), z[i].small_word(), octave[i]]));
                }
            }
        }
    };
}

pub(super) use integer_hash;
