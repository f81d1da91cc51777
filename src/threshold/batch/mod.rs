//! Thresholds by the thousand, in the vector instructions of the machine.
//!
//! Everything here is a second, faster way to numbers that another file defines: not one bit may differ, whatever
//! the instruction set or the number of threads.

pub mod isa;
pub(crate) mod slices;

pub use isa::Isa;

/// How many values a loop handles at once: 128 keep every intermediate array of a threshold in the first cache.
pub const BLOCK: usize = 128;

/// One array of a block.
pub(crate) type Block<T> = [T; BLOCK];
