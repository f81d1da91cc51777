//! Unary and binary operators.

use super::super::error::Unsupported;
use super::super::op::{Binary, Register, Unary};
use super::super::undefined::UndefinedKind;
use super::expression::is_matrix;
use super::types::scalar_kind;
use super::{Compiler, Scope, Value};
use naga::{BinaryOperator, Expression, Handle, ScalarKind, Span, UnaryOperator};

type Result<T> = core::result::Result<T, Unsupported>;

impl<'a> Compiler<'a> {
    pub(super) fn unary_operator(
        &mut self,
        scope: &mut Scope<'a>,
        op: UnaryOperator,
        operand: Handle<Expression>,
    ) -> Result<Value> {
        let kind = scalar_kind(scope.ty(self.module, operand))?;
        let value = self.value(scope, operand)?;
        match (op, kind) {
            (UnaryOperator::Negate, ScalarKind::Float) => self.each(&value, Self::negate),
            (UnaryOperator::Negate, _) => self.each(&value, |c, x| c.unary(Unary::NegateInteger, x)),
            (UnaryOperator::LogicalNot | UnaryOperator::BitwiseNot, _) => {
                self.each(&value, |c, x| c.unary(Unary::Not, x))
            }
        }
    }

    pub(super) fn binary_operator(
        &mut self,
        scope: &mut Scope<'a>,
        op: BinaryOperator,
        [left, right]: [Handle<Expression>; 2],
        span: Span,
    ) -> Result<Value> {
        let left_type = scope.ty(self.module, left).clone();
        let right_type = scope.ty(self.module, right).clone();
        let (left, right) = (self.value(scope, left)?, self.value(scope, right)?);
        let kind = scalar_kind(&left_type)?;
        if op == BinaryOperator::Multiply && (is_matrix(&left_type) || is_matrix(&right_type)) {
            return self.matrix_product([&left_type, &right_type], &left, &right);
        }
        self.each_2(&left, &right, |compiler, x, y| match kind {
            ScalarKind::Float => compiler.float_operator(op, x, y),
            _ => {
                let divides = matches!(op, BinaryOperator::Divide | BinaryOperator::Modulo);
                if divides && compiler.known(y).is_none_or(|y| y == 0) {
                    let zero = compiler.word(0)?;
                    let odd = compiler.binary(Binary::EqualWord, y, zero)?;
                    compiler.count(odd, UndefinedKind::Division, span)?;
                }
                let (function, swapped) = integer_operator(op, kind == ScalarKind::Sint);
                let (x, y) = if swapped { (y, x) } else { (x, y) };
                compiler.binary(function, x, y)
            }
        })
    }

    fn float_operator(&mut self, op: BinaryOperator, x: Register, y: Register) -> Result<Register> {
        match op {
            BinaryOperator::Add => self.add(x, y),
            BinaryOperator::Subtract => self.subtract(x, y),
            BinaryOperator::Multiply => self.multiply(x, y),
            BinaryOperator::Divide => self.divide(x, y),
            BinaryOperator::Modulo => {
                // As WGSL derives it: with the sign of x, and inexact where the quotient is large.
                let quotient = self.divide(x, y)?;
                let whole = self.unary(Unary::Trunc, quotient)?;
                let multiple = self.multiply(y, whole)?;
                self.subtract(x, multiple)
            }
            BinaryOperator::Equal => self.binary(Binary::Equal, x, y),
            BinaryOperator::NotEqual => self.binary(Binary::NotEqual, x, y),
            BinaryOperator::Less => self.binary(Binary::Less, x, y),
            BinaryOperator::LessEqual => self.binary(Binary::LessEqual, x, y),
            BinaryOperator::Greater => self.binary(Binary::Less, y, x),
            BinaryOperator::GreaterEqual => self.binary(Binary::LessEqual, y, x),
            _ => Err(Unsupported::new("a bit operator does not take floats")),
        }
    }
}

/// The function of two words that are no floats, and whether its operands change places.
fn integer_operator(op: BinaryOperator, signed: bool) -> (Binary, bool) {
    let by_sign = |of_signed, of_unsigned| if signed { of_signed } else { of_unsigned };
    let less = by_sign(Binary::LessSigned, Binary::LessUnsigned);
    let less_equal = by_sign(Binary::LessEqualSigned, Binary::LessEqualUnsigned);
    match op {
        BinaryOperator::Add => (Binary::AddInteger, false),
        BinaryOperator::Subtract => (Binary::SubtractInteger, false),
        BinaryOperator::Multiply => (Binary::MultiplyInteger, false),
        BinaryOperator::Divide => (by_sign(Binary::DivideSigned, Binary::DivideUnsigned), false),
        BinaryOperator::Modulo => (by_sign(Binary::RemainderSigned, Binary::RemainderUnsigned), false),
        BinaryOperator::Equal => (Binary::EqualWord, false),
        BinaryOperator::NotEqual => (Binary::NotEqualWord, false),
        BinaryOperator::Less => (less, false),
        BinaryOperator::LessEqual => (less_equal, false),
        BinaryOperator::Greater => (less, true),
        BinaryOperator::GreaterEqual => (less_equal, true),
        BinaryOperator::And | BinaryOperator::LogicalAnd => (Binary::And, false),
        BinaryOperator::InclusiveOr | BinaryOperator::LogicalOr => (Binary::Or, false),
        BinaryOperator::ExclusiveOr => (Binary::Xor, false),
        BinaryOperator::ShiftLeft => (Binary::ShiftLeft, false),
        BinaryOperator::ShiftRight => (by_sign(Binary::ShiftRightSigned, Binary::ShiftRightUnsigned), false),
    }
}
