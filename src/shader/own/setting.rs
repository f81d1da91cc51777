//! Values that a user gives by name: `--set KEY=VALUE`.

use naga::{Literal, Scalar, ScalarKind};

/// A value of a scalar type of WGSL.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A finite float.
    F32(f32),
    /// A signed integer.
    I32(i32),
    /// An unsigned integer.
    U32(u32),
    /// A truth value.
    Bool(bool),
}

impl Value {
    /// Reads a value of a type from what a user wrote; the error names the type.
    pub(super) fn parse(scalar: Scalar, written: &str) -> Result<Self, String> {
        let written = written.trim();
        let value = match (scalar.kind, scalar.width) {
            (ScalarKind::Float, 4) => {
                written.parse().ok().filter(|value: &f32| value.is_finite()).map(Self::F32)
            }
            (ScalarKind::Sint, 4) => written.parse().ok().map(Self::I32),
            (ScalarKind::Uint, 4) => written.parse().ok().map(Self::U32),
            (ScalarKind::Bool, _) => written.parse().ok().map(Self::Bool),
            _ => return Err("only f32, i32, u32 and bool can be given a value".to_owned()),
        };
        value.ok_or_else(|| format!("`{written}` is no {}", type_name(scalar)))
    }

    /// The value as naga writes it.
    pub(super) const fn literal(self) -> Literal {
        match self {
            Self::F32(value) => Literal::F32(value),
            Self::I32(value) => Literal::I32(value),
            Self::U32(value) => Literal::U32(value),
            Self::Bool(value) => Literal::Bool(value),
        }
    }

    /// The value as `f64`, which holds each of them exactly; 1 for true.
    pub(super) fn to_f64(self) -> f64 {
        match self {
            Self::F32(value) => f64::from(value),
            Self::I32(value) => f64::from(value),
            Self::U32(value) => f64::from(value),
            Self::Bool(value) => f64::from(u8::from(value)),
        }
    }

    /// The value as a word of a buffer: its bits; 1 for true.
    #[must_use]
    pub fn word(self) -> u32 {
        match self {
            Self::F32(value) => value.to_bits(),
            Self::I32(value) => value as u32,
            Self::U32(value) => value,
            Self::Bool(value) => u32::from(value),
        }
    }
}

/// The name of a scalar type in messages.
pub(super) const fn type_name(scalar: Scalar) -> &'static str {
    match (scalar.kind, scalar.width) {
        (ScalarKind::Float, 4) => "f32",
        (ScalarKind::Sint, 4) => "i32",
        (ScalarKind::Uint, 4) => "u32",
        (ScalarKind::Bool, _) => "bool",
        (ScalarKind::Float, 2) => "f16",
        (ScalarKind::Float, _) => "f64",
        _ => "a type of its own",
    }
}
