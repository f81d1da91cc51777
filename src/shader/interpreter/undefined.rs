//! Undefined behaviour that a run met: the shading languages leave it open, so it is no error, but hardly meant.

use core::fmt;
use naga::Span;

/// Behaviour that the shading languages leave undefined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum UndefinedKind {
    /// An index beyond the last element, or below the first: the last element is taken.
    Index,
    /// The division of an integer by zero: `x / 0` is `x`, `x % 0` is 0.
    Division,
}

impl fmt::Display for UndefinedKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Index => "an index is out of range; the last element was taken",
            Self::Division => "an integer is divided by zero; x / 0 was x, x % 0 was 0",
        })
    }
}

/// A place where that happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Undefined {
    /// What happened.
    pub kind: UndefinedKind,
    /// Where; undefined where naga does not know.
    pub span: Span,
    /// In how many lanes of all runs so far.
    pub lanes: u64,
}
