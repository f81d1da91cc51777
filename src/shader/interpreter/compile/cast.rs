//! Conversions by value and by bits.

use super::super::error::Unsupported;
use super::super::op::Unary;
use super::types::scalar_kind;
use super::{Compiler, Scope, Value};
use naga::{Expression, Handle, ScalarKind};

impl<'a> Compiler<'a> {
    /// Converts every component; without a width only the reading of the bits changes.
    pub(super) fn cast(
        &mut self,
        scope: &mut Scope<'a>,
        operand: Handle<Expression>,
        to: ScalarKind,
        convert: Option<u8>,
    ) -> Result<Value, Unsupported> {
        let from = scalar_kind(scope.ty(self.module, operand))?;
        let value = self.value(scope, operand)?;
        let function = if convert.is_some() { conversion(from, to) } else { reading(from, to) };
        match function {
            Some(function) => self.each(&value, |compiler, x| compiler.unary(function, x)),
            None => Ok(value),
        }
    }
}

/// The conversion by value, where the bits change at all.
fn conversion(from: ScalarKind, to: ScalarKind) -> Option<Unary> {
    use ScalarKind::{Bool, Float, Sint, Uint};
    match (from, to) {
        (Float, Sint) => Some(Unary::FloatToSigned),
        (Float, Uint) => Some(Unary::FloatToUnsigned),
        (Float, Bool) => Some(Unary::FloatToBool),
        (Sint, Float) => Some(Unary::SignedToFloat),
        (Uint, Float) => Some(Unary::UnsignedToFloat),
        (Sint | Uint, Bool) => Some(Unary::IntegerToBool),
        (Bool, Sint | Uint) => Some(Unary::BoolToInteger),
        (Bool, Float) => Some(Unary::BoolToFloat),
        _ => None,
    }
}

/// What is to be done when bits are read in another way: a float must be one that the device can hold.
fn reading(from: ScalarKind, to: ScalarKind) -> Option<Unary> {
    (to == ScalarKind::Float && from != ScalarKind::Float).then_some(Unary::Float)
}
