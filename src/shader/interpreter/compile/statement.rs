//! Functions and their statements.

use super::super::error::Unsupported;
use super::super::op::{Block, Case, Op, Step, Unary};
use super::{Compiler, DEEPEST_NESTING, Exit, Operand, Place, Scope, Types, Value};
use naga::valid::FunctionInfo;
use naga::{Function, Span, Statement, SwitchValue};
use std::collections::HashMap;

type Result<T> = core::result::Result<T, Unsupported>;

impl<'a> Compiler<'a> {
    /// Compiles a call in place and returns its value, which has no scalar where the function returns nothing.
    pub(super) fn call(
        &mut self,
        function: &'a Function,
        info: &'a FunctionInfo,
        arguments: Vec<Operand>,
    ) -> Result<Value> {
        let at_end = returns(&function.body) == usize::from(ends_with_return(&function.body));
        let exit = if at_end {
            Exit::AtEnd(Vec::new())
        } else {
            let size = function.result.as_ref().map_or(Ok(0), |result| self.size_of(result.ty))?;
            Exit::Anywhere(self.allocate(size)?)
        };
        let mut scope = Scope {
            expressions: &function.expressions,
            types: Types::Function(info),
            arguments,
            locals: Vec::new(),
            operands: HashMap::new(),
            exit,
        };
        for (handle, local) in function.local_variables.iter() {
            let span = function.local_variables.get_span(handle);
            let place = self.local(&mut scope, local).map_err(|error| error.at(span))?;
            scope.locals.push(place);
        }
        if at_end {
            self.nested(|compiler| compiler.statements(&mut scope, &function.body))?;
        } else {
            let body = self.block(&mut scope, &function.body)?;
            self.block.0.push(Step::Call { body });
        }
        match scope.exit {
            Exit::AtEnd(value) | Exit::Anywhere(value) => Ok(value),
        }
    }

    /// A variable of a function, with its initial value.
    fn local(&mut self, scope: &mut Scope<'a>, local: &naga::LocalVariable) -> Result<Place> {
        let size = self.size_of(local.ty)?;
        let registers = self.allocate(size)?;
        let initial = match local.init {
            Some(init) => self.value(scope, init)?,
            None => vec![self.word(0)?; size],
        };
        for (&to, from) in registers.iter().zip(initial) {
            self.push(Op::Unary { function: Unary::Copy, to, from })?;
        }
        let first = registers.first().copied().unwrap_or_default();
        Ok(Place { first, offset: None })
    }

    /// Goes one level deeper.
    fn nested<T>(&mut self, compile: impl FnOnce(&mut Self) -> Result<T>) -> Result<T> {
        if self.nesting == DEEPEST_NESTING {
            return Err(Unsupported::new(format!(
                "calls and blocks that are nested more than {DEEPEST_NESTING} deep are not interpreted"
            )));
        }
        self.nesting += 1;
        let result = compile(self);
        self.nesting -= 1;
        result
    }

    /// Compiles statements to a block of their own.
    fn block(&mut self, scope: &mut Scope<'a>, statements: &'a naga::Block) -> Result<Block> {
        let outside = core::mem::take(&mut self.block);
        self.nested(|compiler| compiler.statements(scope, statements))?;
        Ok(core::mem::replace(&mut self.block, outside))
    }

    fn statements(&mut self, scope: &mut Scope<'a>, statements: &'a naga::Block) -> Result<()> {
        for (statement, &span) in statements.span_iter() {
            self.statement(scope, statement, span).map_err(|error| error.at(span))?;
        }
        Ok(())
    }

    fn statement(&mut self, scope: &mut Scope<'a>, statement: &'a Statement, span: Span) -> Result<()> {
        match *statement {
            Statement::Emit(ref range) => {
                for expression in range.clone() {
                    scope.operands.remove(&expression);
                    self.operand(scope, expression)?;
                }
            }
            Statement::Block(ref block) => self.nested(|compiler| compiler.statements(scope, block))?,
            Statement::If { condition, ref accept, ref reject } => {
                let condition = self.scalar(scope, condition)?;
                let accept = self.block(scope, accept)?;
                let reject = self.block(scope, reject)?;
                self.block.0.push(Step::If { condition, accept, reject });
            }
            Statement::Switch { selector, ref cases } => {
                let selector = self.scalar(scope, selector)?;
                let cases = cases.iter().map(|case| {
                    let value = match case.value {
                        SwitchValue::I32(value) => Some(value as u32),
                        SwitchValue::U32(value) => Some(value),
                        SwitchValue::Default => None,
                    };
                    let body = self.block(scope, &case.body)?;
                    Ok(Case { value, body, falls_through: case.fall_through })
                });
                let cases = cases.collect::<Result<_>>()?;
                self.block.0.push(Step::Switch { selector, cases });
            }
            Statement::Loop { ref body, ref continuing, break_if } => {
                let body = self.block(scope, body)?;
                let continuing = self.block(scope, continuing)?;
                let break_if = break_if.map(|condition| self.scalar(scope, condition)).transpose()?;
                self.block.0.push(Step::Loop { body, continuing, break_if, span });
            }
            Statement::Break => self.block.0.push(Step::Break),
            Statement::Continue => self.block.0.push(Step::Continue),
            Statement::Return { value } => {
                let value = value.map_or(Ok(Vec::new()), |value| self.value(scope, value))?;
                match &mut scope.exit {
                    Exit::AtEnd(returned) => *returned = value,
                    Exit::Anywhere(result) => {
                        for (&to, from) in result.iter().zip(value) {
                            self.push(Op::Store { to, from })?;
                        }
                        self.block.0.push(Step::Return);
                    }
                }
            }
            Statement::Store { pointer, value } => {
                let place = self.pointer(scope, pointer)?;
                let value = self.value(scope, value)?;
                self.store(place, &value)?;
            }
            Statement::Call { function, ref arguments, result } => {
                let arguments =
                    arguments.iter().map(|&argument| self.operand(scope, argument)).collect::<Result<_>>()?;
                let callee = &self.module.functions[function];
                let value =
                    self.nested(|compiler| compiler.call(callee, &compiler.info[function], arguments))?;
                if let Some(result) = result {
                    scope.operands.insert(result, Operand::Value(value));
                }
            }
            ref other => return Err(Unsupported::new(refusal(other))),
        }
        Ok(())
    }
}

/// Why a statement is not taken.
fn refusal(statement: &Statement) -> &'static str {
    match statement {
        Statement::Kill => "`discard` is not interpreted; return a value instead",
        Statement::ControlBarrier(_)
        | Statement::MemoryBarrier(_)
        | Statement::WorkGroupUniformLoad { .. } => {
            "barriers are not interpreted: lanes know nothing of each other"
        }
        Statement::Atomic { .. } => "atomics are not interpreted",
        Statement::ImageStore { .. } | Statement::ImageAtomic { .. } => "textures are not interpreted",
        Statement::RayQuery { .. } | Statement::RayPipelineFunction(_) => "ray queries are not interpreted",
        _ => "operations across lanes are not interpreted",
    }
}

/// The number of returns in a block and all within it.
fn returns(block: &naga::Block) -> usize {
    let within = |statement: &Statement| match statement {
        Statement::Return { .. } => 1,
        Statement::Block(block) => returns(block),
        Statement::If { accept, reject, .. } => returns(accept) + returns(reject),
        Statement::Switch { cases, .. } => cases.iter().map(|case| returns(&case.body)).sum(),
        Statement::Loop { body, continuing, .. } => returns(body) + returns(continuing),
        _ => 0,
    };
    block.iter().map(within).sum()
}

/// Whether the last thing that a block does is to return.
fn ends_with_return(block: &naga::Block) -> bool {
    match block.last() {
        Some(Statement::Return { .. }) => true,
        Some(Statement::Block(block)) => ends_with_return(block),
        _ => false,
    }
}
