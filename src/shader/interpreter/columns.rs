//! What goes into a run and what comes out: one value a lane.

use super::lanes;
use core::fmt;

/// What a scalar is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// A float of 32 bits.
    F32,
    /// A signed integer of 32 bits.
    I32,
    /// An unsigned integer of 32 bits.
    U32,
    /// A truth value.
    Bool,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::F32 => "f32",
            Self::I32 => "i32",
            Self::U32 => "u32",
            Self::Bool => "bool",
        })
    }
}

/// The values of one scalar of a parameter: one a lane, or one for all lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Column<'a> {
    /// Floats.
    F32(&'a [f32]),
    /// Signed integers.
    I32(&'a [i32]),
    /// Unsigned integers.
    U32(&'a [u32]),
    /// Truth values.
    Bool(&'a [bool]),
}

impl Column<'_> {
    /// Returns what the values are.
    #[must_use]
    pub const fn kind(&self) -> Kind {
        match self {
            Self::F32(_) => Kind::F32,
            Self::I32(_) => Kind::I32,
            Self::U32(_) => Kind::U32,
            Self::Bool(_) => Kind::Bool,
        }
    }

    /// Returns the number of values.
    #[must_use]
    pub const fn len(&self) -> usize {
        match self {
            Self::F32(values) => values.len(),
            Self::I32(values) => values.len(),
            Self::U32(values) => values.len(),
            Self::Bool(values) => values.len(),
        }
    }

    /// Returns whether there is no value.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Copies the values from lane `start` on; lanes beyond the last one repeat it.
    pub(super) fn load(&self, start: usize, lanes: usize, to: &lanes::Column) {
        match self {
            Self::F32(values) => load(values, start, lanes, to, |value: f32| value.to_bits()),
            Self::I32(values) => load(values, start, lanes, to, |value| value as u32),
            Self::U32(values) => load(values, start, lanes, to, |value| value),
            Self::Bool(values) => load(values, start, lanes, to, |value| u32::from(value).wrapping_neg()),
        }
    }
}

fn load<T: Copy>(values: &[T], start: usize, lanes: usize, to: &lanes::Column, word: impl Fn(T) -> u32) {
    let values = if values.len() == 1 { values } else { &values[start..lanes] };
    let Some(&last) = values.last() else { return };
    let padded = values.iter().copied().chain(core::iter::repeat(last));
    for (to, value) in to.iter().zip(padded) {
        to.set(word(value));
    }
}

/// The values of one scalar of a result, one a lane.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Floats.
    F32(Vec<f32>),
    /// Signed integers.
    I32(Vec<i32>),
    /// Unsigned integers.
    U32(Vec<u32>),
    /// Truth values.
    Bool(Vec<bool>),
}

impl Values {
    pub(super) fn collect(kind: Kind, words: impl Iterator<Item = u32>) -> Self {
        match kind {
            Kind::F32 => Self::F32(words.map(f32::from_bits).collect()),
            Kind::I32 => Self::I32(words.map(|word| word as i32).collect()),
            Kind::U32 => Self::U32(words.collect()),
            Kind::Bool => Self::Bool(words.map(|word| word != 0).collect()),
        }
    }
}
