//! Functions that are put around a user's.

use naga::{Arena, Block, Expression, Function, Handle, Span, Statement};

/// A function body under construction.
#[derive(Default)]
pub(super) struct Body {
    pub expressions: Arena<Expression>,
    pub block: Block,
}

impl Body {
    pub fn append(&mut self, expression: Expression) -> Handle<Expression> {
        self.expressions.append(expression, Span::UNDEFINED)
    }

    /// Appends an expression that is computed here.
    pub fn emit(&mut self, expression: Expression) -> Handle<Expression> {
        let before = self.expressions.len();
        let handle = self.append(expression);
        self.block.push(Statement::Emit(self.expressions.range_from(before)), Span::UNDEFINED);
        handle
    }

    /// Ends with a call whose result is returned.
    pub fn return_call(&mut self, function: Handle<Function>, arguments: Vec<Handle<Expression>>) {
        let result = Some(self.append(Expression::CallResult(function)));
        self.block.push(Statement::Call { function, arguments, result }, Span::UNDEFINED);
        self.block.push(Statement::Return { value: result }, Span::UNDEFINED);
    }
}
