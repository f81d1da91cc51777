//! Lanes of a block, sets of them, and one word of each.

use crate::threshold::batch::BLOCK;
use core::cell::Cell;

/// Lanes of a block.
pub(super) const LANES: usize = BLOCK;

/// A set of lanes.
pub(super) type Lanes = u128;
const _: () = assert!(LANES == Lanes::BITS as usize, "one bit a lane");

/// One word a lane.
pub(super) type Column = [Cell<u32>; LANES];
