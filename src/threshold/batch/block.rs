//! Blocks of lanes.

/// How many footprints a stage handles at once: 128 keep every intermediate array in the first cache.
pub const BLOCK: usize = 128;

/// One array of a block.
pub(crate) type Block<T> = [T; BLOCK];
