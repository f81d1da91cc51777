//! A function that is ready to run.

use super::columns::Kind;
use super::op::{Block, Register};
use super::undefined::UndefinedKind;
use core::sync::atomic::AtomicU64;
use naga::Span;
use std::sync::Arc;

/// A function that is ready to run.
#[derive(Clone, Debug)]
pub struct Program {
    /// The most operations and rounds of loops that a block of 128 lanes may take in one run.
    pub steps: u64,
    pub(super) parameters: Vec<Parameter>,
    pub(super) result: Vec<Kind>,
    /// The registers of all scalars of all parameters in order, and of the result.
    pub(super) arguments: Vec<Register>,
    pub(super) results: Vec<Register>,
    pub(super) constants: Vec<(Register, Constant)>,
    pub(super) body: Block,
    pub(super) registers: usize,
    /// What can happen where, and in how many lanes it did; clones count together.
    pub(super) undefined: Vec<(UndefinedKind, Span)>,
    pub(super) counts: Arc<[AtomicU64]>,
}

/// A parameter of a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// Its name in the source.
    pub name: String,
    /// Its scalars: the components of a vector, the columns of a matrix, the members of a structure one after the
    /// other.
    pub components: Vec<Kind>,
}

/// A word that is the same in all lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Constant {
    pub(super) bits: u32,
    /// Whether a device rounds it.
    pub(super) float: bool,
}
