//! What the list of hashes says of each, and how each goes over a block of cells.

use crate::threshold::batch::block::Block;
use crate::threshold::batch::lane::Kernel;

/// One hash of the list.
pub(crate) struct Listed {
    /// The name by which a user asks for it.
    pub name: &'static str,
    /// Whether it reads the octave of a cell.
    pub reads_octave: bool,
    /// Whether it is made of integers, so that every machine gives the same bits.
    pub is_exact: bool,
    /// The shortest known vector of cells after which all its values are repeated.
    pub repeats_after: Option<[i32; 3]>,
    /// The text that declares its `hash_cell`, after what that needs.
    #[cfg(feature = "shader")]
    pub wgsl: &'static [&'static str],
    /// A piece of the text, and what to put in its place for a hash that is wrong.
    #[cfg(feature = "gpu")]
    pub mistake: [&'static str; 2],
}

/// A hash over a block of cells, without a branch.
pub(in crate::threshold) trait OfBlocks {
    /// Whether it asks for a sine: the others are the same loop in every tier, and are compiled once.
    const ASKS_SINE: bool = false;

    /// Writes the hashes of cells; `sine` is that of the tier, `FUSED` as in [`Kernel`].
    fn block<R: Kernel, const FUSED: bool>(
        sine: impl Fn(R) -> R + Copy,
        index: [&Block<R>; 3],
        octave: &Block<u32>,
        out: &mut Block<R>,
    );
}
