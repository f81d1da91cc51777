//! Expressions.

use super::super::error::Unsupported;
use super::super::op::{Binary, Register, Unary};
use super::types::scalar_kind;
use super::{Compiler, Operand, Place, Scope, Value};
use naga::{Expression, Handle, Literal, Override, RelationalFunction, ScalarKind, TypeInner};

type Result<T> = core::result::Result<T, Unsupported>;

impl<'a> Compiler<'a> {
    /// The value or the pointer that an expression is; compiled on first use.
    pub(super) fn operand(&mut self, scope: &mut Scope<'a>, handle: Handle<Expression>) -> Result<Operand> {
        if let Some(operand) = scope.operands.get(&handle) {
            return Ok(operand.clone());
        }
        let span = scope.expressions.get_span(handle);
        let operand = self.expression(scope, handle).map_err(|error| error.at(span))?;
        scope.operands.insert(handle, operand.clone());
        Ok(operand)
    }

    pub(super) fn value(&mut self, scope: &mut Scope<'a>, handle: Handle<Expression>) -> Result<Value> {
        match self.operand(scope, handle)? {
            Operand::Value(value) => Ok(value),
            Operand::Pointer(_) => Err(Unsupported::new("a pointer is no value here")),
        }
    }

    pub(super) fn scalar(&mut self, scope: &mut Scope<'a>, handle: Handle<Expression>) -> Result<Register> {
        match self.value(scope, handle)?.as_slice() {
            &[only] => Ok(only),
            _ => Err(Unsupported::new("a scalar is wanted here")),
        }
    }

    pub(super) fn pointer(&mut self, scope: &mut Scope<'a>, handle: Handle<Expression>) -> Result<Place> {
        match self.operand(scope, handle)? {
            Operand::Pointer(place) => Ok(place),
            Operand::Value(_) => Err(Unsupported::new("a pointer is wanted here")),
        }
    }

    fn expression(&mut self, scope: &mut Scope<'a>, handle: Handle<Expression>) -> Result<Operand> {
        let expressions = scope.expressions;
        let value = match expressions[handle] {
            Expression::FunctionArgument(index) => return Ok(scope.arguments[index as usize].clone()),
            Expression::LocalVariable(local) => return Ok(Operand::Pointer(scope.locals[local.index()])),
            Expression::GlobalVariable(global) => return self.global(global).map(Operand::Pointer),
            Expression::AccessIndex { base, index } => return self.access_index(scope, base, index),
            Expression::Access { base, index } => {
                return self.access(scope, base, index, expressions.get_span(handle));
            }
            Expression::Load { pointer } => {
                let size = self.size(&self.pointee(scope.ty(self.module, pointer)))?;
                let place = self.pointer(scope, pointer)?;
                self.load(place, size)?
            }
            Expression::Literal(literal) => vec![self.literal(literal)?],
            Expression::Constant(constant) => {
                let init = self.module.constants[constant].init;
                self.value(&mut Scope::of_module(self.module, self.info), init)?
            }
            Expression::Override(handle) => self.pipeline_constant(handle)?,
            Expression::ZeroValue(ty) => vec![self.word(0)?; self.size_of(ty)?],
            Expression::Compose { ref components, .. } => {
                let mut value = Vec::new();
                for &component in components {
                    value.extend(self.value(scope, component)?);
                }
                value
            }
            Expression::Splat { size, value } => vec![self.scalar(scope, value)?; size as usize],
            Expression::Swizzle { size, vector, pattern } => {
                let vector = self.value(scope, vector)?;
                pattern[..size as usize].iter().map(|&component| vector[component as usize]).collect()
            }
            Expression::Unary { op, expr } => self.unary_operator(scope, op, expr)?,
            Expression::Binary { op, left, right } => {
                self.binary_operator(scope, op, [left, right], expressions.get_span(handle))?
            }
            Expression::Select { condition, accept, reject } => {
                let (condition, accept, reject) =
                    (self.value(scope, condition)?, self.value(scope, accept)?, self.value(scope, reject)?);
                self.each_3([&condition, &accept, &reject], Self::select)?
            }
            Expression::Relational { fun, argument } => self.relational(scope, fun, argument)?,
            Expression::Math { fun, arg, arg1, arg2, arg3 } => {
                let mut arguments = vec![self.value(scope, arg)?];
                for argument in [arg1, arg2, arg3].into_iter().flatten() {
                    arguments.push(self.value(scope, argument)?);
                }
                let ty = scope.ty(self.module, arg).clone();
                self.math(fun, &ty, &arguments)?
            }
            Expression::As { expr, kind, convert } => self.cast(scope, expr, kind, convert)?,
            ref other => return Err(Unsupported::new(refusal(other))),
        };
        self.size(scope.ty(self.module, handle))?;
        Ok(Operand::Value(value))
    }

    fn literal(&mut self, literal: Literal) -> Result<Register> {
        match literal {
            Literal::F32(value) => self.float(value),
            Literal::U32(value) => self.word(value),
            Literal::I32(value) => self.word(value as u32),
            Literal::Bool(value) => self.word(u32::from(value).wrapping_neg()),
            _ => Err(Unsupported::new("numbers of 16 or 64 bits are not interpreted; use 32 bits")),
        }
    }

    /// The default of an override, computed once before the function.
    fn pipeline_constant(&mut self, handle: Handle<Override>) -> Result<Value> {
        if let Some(value) = self.overrides.get(&handle) {
            return Ok(value.clone());
        }
        let constant = &self.module.overrides[handle];
        let Some(init) = constant.init else {
            let name = constant.name.as_deref().unwrap_or("without a name");
            return Err(Unsupported::new(format!("override `{name}` has no default")));
        };
        let value = self
            .before(|compiler| compiler.value(&mut Scope::of_module(compiler.module, compiler.info), init))?;
        self.overrides.insert(handle, value.clone());
        Ok(value)
    }

    fn relational(
        &mut self,
        scope: &mut Scope<'a>,
        fun: RelationalFunction,
        argument: Handle<Expression>,
    ) -> Result<Value> {
        let kind = scalar_kind(scope.ty(self.module, argument))?;
        let value = self.value(scope, argument)?;
        let join = match fun {
            RelationalFunction::All => Binary::And,
            RelationalFunction::Any => Binary::Or,
            RelationalFunction::IsNan | RelationalFunction::IsInf if kind != ScalarKind::Float => {
                return Err(Unsupported::new("only a float can be NaN or infinite"));
            }
            RelationalFunction::IsNan => return self.each(&value, |c, x| c.unary(Unary::IsNan, x)),
            RelationalFunction::IsInf => return self.each(&value, |c, x| c.unary(Unary::IsInf, x)),
        };
        let (first, rest) = value.split_first().ok_or_else(|| Unsupported::new("an empty vector"))?;
        let mut joined = *first;
        for &next in rest {
            joined = self.binary(join, joined, next)?;
        }
        Ok(vec![joined])
    }
}

/// Why an expression is not taken.
fn refusal(expression: &Expression) -> &'static str {
    match expression {
        Expression::Derivative { .. } => {
            "derivatives are not interpreted, since a lane has no neighbours; take them as parameters"
        }
        Expression::ImageSample { .. } | Expression::ImageLoad { .. } | Expression::ImageQuery { .. } => {
            "textures are not interpreted"
        }
        Expression::AtomicResult { .. } => "atomics are not interpreted",
        Expression::ArrayLength(_) => "buffers are not interpreted",
        Expression::CallResult(_) => "the value of a call is used before the call",
        _ => "an expression of this kind is not interpreted",
    }
}

/// Whether a type is a matrix.
pub(super) fn is_matrix(ty: &TypeInner) -> bool {
    matches!(ty, TypeInner::Matrix { .. })
}
