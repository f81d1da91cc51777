//! Thresholds by the thousand, in the vector instructions of the machine.
//!
//! A second, faster way to the numbers that a [`Model`] defines: with [`Tier::BitExact`] not one bit
//! differs, whatever the instruction set or the number of threads. Footprints come as a structure of arrays
//! ([`Columns`]). They are evaluated in blocks of [`BLOCK`], stage by stage, each stage one short loop without a
//! branch; where the scalar path would have branched away from the common case (a derivative of zero, a cell beyond
//! the domain of the sine), the loop leaves NaN and the scalar path is asked.
//!
//! | module | holds |
//! |---|---|
//! | [`isa`] | instruction sets and their choice at run time |
//! | [`columns`] | footprints as a structure of arrays |
//! | `lane`, `double` | sine, logarithm and powers of two without a branch, in `f32` and `f64` |
//! | `plan` | a model as the loops want it |
//! | `octaves`, `cells`, `evaluate` | the stages |
//! | `slices` | [`Isa::sin`], [`Isa::log2`] and [`Isa::hash`] |
//! | `stream`, `bins`, `bin_count` | any number of thresholds on every core, counted as they come |
//!
//! Not in the paper.

// A lane is one index into several arrays.
#![allow(clippy::needless_range_loop)]

mod bin_count;
mod bins;
pub(crate) mod block;
mod cells;
pub mod columns;
mod double;
mod evaluate;
mod evaluator;
pub mod isa;
pub(in crate::threshold) mod lane;
mod nested;
mod octaves;
mod plan;
pub(crate) mod slices;
mod stream;
mod tier;

pub use super::model::Model;
pub use bins::Bins;
pub use block::BLOCK;
pub use columns::{ColumnBuffer, Columns};
pub use evaluator::{Batch, Lane};
pub use isa::Isa;
pub use stream::CHUNK;
pub use tier::Tier;
