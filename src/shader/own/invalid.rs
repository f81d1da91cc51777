//! Whether a module is valid, and in a user's words why it is not: naga names types and values by their numbers, and gives
//! the place of a value where it comes from.

use super::error::Fault;
use super::signature::{described, described_inner};
use core::error::Error as _;
use core::ops::Range;
use naga::front::Typifier;
use naga::proc::ResolveContext;
use naga::valid::{
    CallError, Capabilities, ExpressionError, FunctionError, ModuleInfo, TypeError, ValidationError,
    ValidationFlags, Validator,
};
use naga::{BinaryOperator, Block, Expression, Function, Handle, Module, Span, Statement, TypeInner};

/// Validates a module, which may use whatever naga knows.
///
/// # Errors
///
/// What is wrong with it, at the innermost place that naga knows.
pub(super) fn validate(module: &Module) -> Result<ModuleInfo, Fault> {
    validate_for(module, Capabilities::all())
}

/// Validates a module that uses nothing but what every device has, pairs of 16 bits in a word among it.
///
/// # Errors
///
/// As those of [`validate`].
pub(super) fn validate_plain(module: &Module) -> Result<ModuleInfo, Fault> {
    validate_for(module, Capabilities::SHADER_FLOAT16_IN_FLOAT32)
}

fn validate_for(module: &Module, capabilities: Capabilities) -> Result<ModuleInfo, Fault> {
    Validator::new(ValidationFlags::all(), capabilities).validate(module).map_err(|error| {
        let known = wrong_type(module, error.as_inner()).or_else(|| circle(module, error.as_inner()));
        if let Some(fault) = known {
            return fault;
        }
        // The shortest is the innermost.
        let at = error.spans().filter_map(|(span, _)| span.to_range()).min_by_key(ExactSizeIterator::len);
        let mut causes = Vec::new();
        let mut cause = error.as_inner().source();
        while let Some(next) = cause {
            let said = next.to_string();
            // What is wrong with the value comes behind it.
            causes.extend((!said.starts_with("Expression [")).then_some(said));
            cause = next.source();
        }
        Fault::new(joined(&first_words(error.as_inner()), causes)).at(at)
    })
}

/// Joins a message and what else is to be said, without saying anything twice.
pub(super) fn joined(message: &str, rest: impl IntoIterator<Item = String>) -> String {
    let mut parts = vec![message.to_owned()];
    parts.extend(rest.into_iter().filter(|part| part != message));
    parts.join(": ")
}

fn first_words(error: &ValidationError) -> String {
    match error {
        ValidationError::Function { name, .. } => format!("in `{name}`"),
        ValidationError::Type { source: TypeError::WidthError(_), .. } => {
            "numbers of 16 or 64 bits are not taken; use 32 bits".to_owned()
        }
        other => other.to_string(),
    }
}

/// What is said of functions that come back to themselves.
pub(super) const CIRCLE: &str = "functions that call each other in a circle; no shading language allows that";

/// A function that calls one which is complete only behind it: they call each other.
fn circle(module: &Module, error: &ValidationError) -> Option<Fault> {
    let ValidationError::InvalidHandle(_) = error else { return None };
    module.functions.iter().find_map(|(caller, within)| {
        let is_ahead = |statement: &Statement| {
            matches!(*statement, Statement::Call { function, .. } if function.index() >= caller.index())
        };
        let at = find(&within.body, &is_ahead)?;
        Some(Fault::new(CIRCLE).at(Some(at)))
    })
}

/// A value of a type that its place does not take.
fn wrong_type(module: &Module, error: &ValidationError) -> Option<Fault> {
    let ValidationError::Function { handle, name, source } = error else { return None };
    let function = &module.functions[*handle];
    let typed = |expression| type_of(module, function, expression);
    let body = &function.body;
    Some(match *source {
        FunctionError::InvalidReturnType { expression, expected_ty } => {
            let declared = expected_ty.map_or("nothing".to_owned(), |ty| described(module, ty));
            let found = expression.map_or("nothing".to_owned(), typed);
            let is_return = |statement: &Statement| matches!(*statement, Statement::Return { value } if value == expression);
            let at = find(body, &is_return).or_else(|| module.functions.get_span(*handle).to_range());
            Fault::new(format!("`{name}` returns {found} here, where {declared} is declared")).at(at)
        }
        FunctionError::InvalidStoreTypes { pointer, value } => {
            let is_store = |statement: &Statement| matches!(*statement, Statement::Store { pointer: to, value: from } if (to, from) == (pointer, value));
            let message = format!("a value of type {} cannot become a {}", typed(value), typed(pointer));
            Fault::new(message).at(find(body, &is_store))
        }
        FunctionError::InvalidIfType(condition) => {
            let is_if = |statement: &Statement| matches!(*statement, Statement::If { condition: this, .. } if this == condition);
            Fault::new(format!("a condition is a bool; this is {}", typed(condition))).at(find(body, &is_if))
        }
        FunctionError::InvalidCall { function: called, error: ref wrong } => {
            let is_call = |statement: &Statement| matches!(*statement, Statement::Call { function, .. } if function == called);
            let callee = module.functions[called].name.as_deref().unwrap_or("a function");
            match *wrong {
                CallError::ArgumentType { index, required, seen_expression } => {
                    let (found, wanted) = (typed(seen_expression), described(module, required));
                    let message = format!("argument {} of `{callee}` is {found}, not {wanted}", index + 1);
                    Fault::new(message).at(find(body, &is_call))
                }
                CallError::ArgumentCount { required, seen } => {
                    Fault::new(format!("`{callee}` takes {required} arguments, not {seen}"))
                        .at(find(body, &is_call))
                }
                _ => return None,
            }
        }
        FunctionError::Expression { handle, source: ref wrong } => {
            let at = function.expressions.get_span(handle).to_range();
            let ExpressionError::InvalidBinaryOperandTypes { op, ref lhs_type, ref rhs_type, .. } = *wrong
            else {
                return None;
            };
            let [left, right] = [lhs_type, rhs_type].map(|ty| described_inner(module, ty));
            Fault::new(format!("`{}` does not take {left} and {right}", sign(op))).at(at)
        }
        _ => return None,
    })
}

/// The type of an expression; for a pointer, that of what it points to.
fn type_of(module: &Module, function: &Function, expression: Handle<Expression>) -> String {
    let context = ResolveContext::with_locals(module, &function.local_variables, &function.arguments);
    let mut types = Typifier::new();
    if types.grow(expression, &function.expressions, &context).is_err() {
        return "another type".to_owned();
    }
    match *types.get(expression, &module.types) {
        TypeInner::Pointer { base, .. } => described(module, base),
        TypeInner::ValuePointer { size: Some(size), scalar, .. } => {
            described_inner(module, &TypeInner::Vector { size, scalar })
        }
        TypeInner::ValuePointer { scalar, .. } => described_inner(module, &TypeInner::Scalar(scalar)),
        ref inner => described_inner(module, inner),
    }
}

/// The functions that a body calls.
pub(super) fn called_by(block: &Block) -> Vec<Handle<Function>> {
    block
        .iter()
        .flat_map(|statement| match statement {
            Statement::Call { function, .. } => vec![*function],
            Statement::Block(inner) => called_by(inner),
            Statement::If { accept, reject, .. } => [called_by(accept), called_by(reject)].concat(),
            Statement::Switch { cases, .. } => cases.iter().flat_map(|case| called_by(&case.body)).collect(),
            Statement::Loop { body, continuing, .. } => [called_by(body), called_by(continuing)].concat(),
            _ => Vec::new(),
        })
        .collect()
}

/// Finds the first statement that is wanted.
pub(super) fn find(block: &Block, wanted: &impl Fn(&Statement) -> bool) -> Option<Range<usize>> {
    let place = |span: &Span| span.to_range();
    block.span_iter().find_map(|(statement, span)| match statement {
        statement if wanted(statement) => place(span),
        Statement::Block(inner) => find(inner, wanted),
        Statement::If { accept, reject, .. } => find(accept, wanted).or_else(|| find(reject, wanted)),
        Statement::Switch { cases, .. } => cases.iter().find_map(|case| find(&case.body, wanted)),
        Statement::Loop { body, continuing, .. } => find(body, wanted).or_else(|| find(continuing, wanted)),
        _ => None,
    })
}

const fn sign(operator: BinaryOperator) -> &'static str {
    match operator {
        BinaryOperator::Add => "+",
        BinaryOperator::Subtract => "-",
        BinaryOperator::Multiply => "*",
        BinaryOperator::Divide => "/",
        BinaryOperator::Modulo => "%",
        BinaryOperator::Equal => "==",
        BinaryOperator::NotEqual => "!=",
        BinaryOperator::Less => "<",
        BinaryOperator::LessEqual => "<=",
        BinaryOperator::Greater => ">",
        BinaryOperator::GreaterEqual => ">=",
        BinaryOperator::And => "&",
        BinaryOperator::ExclusiveOr => "^",
        BinaryOperator::InclusiveOr => "|",
        BinaryOperator::LogicalAnd => "&&",
        BinaryOperator::LogicalOr => "||",
        BinaryOperator::ShiftLeft => "<<",
        BinaryOperator::ShiftRight => ">>",
    }
}
