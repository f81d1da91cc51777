//! A test of an alpha that is not a plain comparison: its threshold is the alpha at which its answer changes, found by halving.
//!
//! The function may return whether to keep a fragment (or whether to discard it), an alpha or a colour that is 0 where it is
//! discarded, write such a one to a parameter, or discard. The alpha is halved in steps of its own bits from 0 to 1, so that the last
//! of 30 steps tells two neighbouring floats apart; it is then tried in [`PROBES`] places whether all alphas above are kept and all
//! below are not. A test that is not of that kind has no threshold: it answers NaN, which the claims reject.

use super::body::Body;
use super::error::Fault;
use super::invalid::called_by;
use super::options::{ALPHA, Options};
use super::usual::{is_alpha, meaning_of};
use super::waiting::reached_from;
use naga::{
    AddressSpace, BinaryOperator, Block, Expression, Function, FunctionArgument, FunctionResult,
    GlobalVariable, Handle, Literal, LocalVariable, Module, Scalar, ScalarKind, Span, Statement, SwitchCase,
    Type, TypeInner, UnaryOperator, VectorSize,
};
use std::collections::{BTreeMap, BTreeSet};

/// As many halvings as the floats from 0 to 1 have bits that differ.
const HALVINGS: u32 = 30;
/// In how many places between 0 and 1 it is tried whether the test has one threshold.
const PROBES: u32 = 16;
/// The bits of 1 and of NaN.
const ONE: u32 = 0x3f80_0000;
const NAN: u32 = 0x7fc0_0000;

/// What a test says about a fragment, and where.
#[derive(Clone, Copy)]
enum Answer {
    /// A bool that it returns.
    Bool,
    /// A number that it returns, or the fourth component of a colour: kept above 0.
    Returned { is_colour: bool },
    /// The same in the parameter that had the alpha.
    Written,
    /// Nothing: it discards.
    Discards,
}

/// Puts a function that returns the threshold in the place of a test of an alpha, with a sentence that says so; any other function
/// stays.
///
/// # Errors
///
/// A function that answers nothing to the parameter that `--map alpha=NAME` names.
pub(super) fn wrap(
    module: &mut Module,
    target: Handle<Function>,
    asked: &Options,
    settings: &BTreeMap<String, String>,
) -> Result<(Handle<Function>, Option<String>), Fault> {
    let function = &module.functions[target];
    // `color.a` is in the parameter `color`.
    let said = asked.map.get(ALPHA).and_then(|name| name.split('.').next());
    let is_it = |argument: &FunctionArgument| {
        let name = argument.name.as_deref().unwrap_or_default();
        said.map_or_else(|| is_alpha(name) && !settings.contains_key(name), |said| said == name)
    };
    let mut found = function.arguments.iter().position(is_it);
    let result = function.result.as_ref().map(|result| &module.types[result.ty].inner);
    // Where none sounds like it, the only number of a function that has a test for its only purpose.
    let is_bool = matches!(result, Some(TypeInner::Scalar(Scalar::BOOL)));
    if found.is_none() && said.is_none() && (is_bool || result.is_none()) {
        let may_be = |argument: &FunctionArgument| {
            let name = argument.name.as_deref().unwrap_or_default();
            let ty = match module.types[argument.ty].inner {
                TypeInner::Pointer { base, space: AddressSpace::Function } => base,
                _ => argument.ty,
            };
            let is_number = matches!(module.types[ty].inner, TypeInner::Scalar(Scalar::F32));
            is_number && !settings.contains_key(name) && meaning_of(name).is_none()
        };
        let mut numbers = function.arguments.iter().enumerate().filter(|(_, argument)| may_be(argument));
        found = numbers.next().map(|(index, _)| index).filter(|_| numbers.next().is_none());
    }
    let discards =
        reached_from(module, target).iter().any(|&function| has_kill(&module.functions[function].body));
    let answer = match (found.map(|index| is_written(module, function.arguments[index].ty)), result) {
        (Some(Some(_)), Some(TypeInner::Scalar(Scalar::BOOL))) => Some(Answer::Bool),
        (Some(Some(_)), Some(TypeInner::Scalar(Scalar::F32))) => Some(Answer::Returned { is_colour: false }),
        (Some(Some(_)), Some(TypeInner::Vector { size: VectorSize::Quad, scalar: Scalar::F32 })) => {
            Some(Answer::Returned { is_colour: true })
        }
        (Some(Some(_)), None) if discards => Some(Answer::Discards),
        (Some(Some(true)), None) => Some(Answer::Written),
        _ => None,
    };
    let (Some(alpha), Some(answer)) = (found, answer) else {
        let Some(name) = said else { return Ok((target, None)) };
        let parameters: Vec<_> =
            function.arguments.iter().filter_map(|argument| argument.name.clone()).collect();
        return Err(Fault::new(format!(
            "--map alpha={name}: `{}` has no test of `{name}`. A test compares it with something that is made of the position, or takes \
             it as a parameter (a number or a colour; here are {}) and returns a bool, a number or a colour, writes it, or discards",
            asked.function,
            if parameters.is_empty() { "none".to_owned() } else { parameters.join(", ") }
        )));
    };
    let name = module.functions[target].arguments[alpha].name.clone().unwrap_or_default();
    let note = format!("`{}` is a test of `{name}`: its threshold is found by halving", asked.function);
    let gone = discards.then(|| without_discards(module, target));
    let kept = kept(module, target, alpha, answer, gone);
    Ok((halving(module, target, kept), Some(note)))
}

/// Whether a parameter that may hold an alpha, a number or a colour, is written to; nothing for one of another type.
fn is_written(module: &Module, ty: Handle<Type>) -> Option<bool> {
    let (ty, is_pointer) = match module.types[ty].inner {
        TypeInner::Pointer { base, space: AddressSpace::Function } => (base, true),
        _ => (ty, false),
    };
    match module.types[ty].inner {
        TypeInner::Scalar(Scalar::F32) => Some(is_pointer),
        TypeInner::Vector { size: VectorSize::Quad, scalar: Scalar::F32 } => Some(is_pointer),
        _ => None,
    }
}

fn has_kill(block: &Block) -> bool {
    block.iter().any(|statement| match statement {
        Statement::Kill => true,
        Statement::Block(inner) => has_kill(inner),
        Statement::If { accept, reject, .. } => has_kill(accept) || has_kill(reject),
        Statement::Switch { cases, .. } => cases.iter().any(|case| has_kill(&case.body)),
        Statement::Loop { body, continuing, .. } => has_kill(body) || has_kill(continuing),
        _ => false,
    })
}

/// Makes every `discard` a return that leaves a mark, which callers hand on; returns the variable of the mark.
fn without_discards(module: &mut Module, target: Handle<Function>) -> Handle<GlobalVariable> {
    let bool_type =
        module.types.insert(Type { name: None, inner: TypeInner::Scalar(Scalar::BOOL) }, Span::UNDEFINED);
    let init =
        Some(module.global_expressions.append(Expression::Literal(Literal::Bool(false)), Span::UNDEFINED));
    let variable = GlobalVariable {
        name: Some("is_discarded".to_owned()),
        space: AddressSpace::Private,
        binding: None,
        ty: bool_type,
        init,
        memory_decorations: naga::MemoryDecorations::empty(),
    };
    let gone = module.global_variables.append(variable, Span::UNDEFINED);
    let reached = reached_from(module, target);
    let mut discarding: BTreeSet<_> =
        reached.iter().copied().filter(|&function| has_kill(&module.functions[function].body)).collect();
    loop {
        let callers = reached.iter().copied().filter(|&function| {
            called_by(&module.functions[function].body).iter().any(|called| discarding.contains(called))
        });
        let all: BTreeSet<_> = discarding.iter().copied().chain(callers).collect();
        if all.len() == discarding.len() {
            break;
        }
        discarding = all;
    }
    for &function in &discarding {
        let mut changed = core::mem::take(&mut module.functions[function]);
        let body = core::mem::take(&mut changed.body);
        changed.body = marked(&mut changed, &body, gone, &discarding);
        module.functions[function] = changed;
    }
    gone
}

/// The way out of a function that is left with a mark.
fn leave(function: &mut Function) -> Block {
    let value = function
        .result
        .as_ref()
        .map(|result| result.ty)
        .map(|ty| function.expressions.append(Expression::ZeroValue(ty), Span::UNDEFINED));
    Block::from_vec(vec![Statement::Return { value }])
}

fn marked(
    function: &mut Function,
    block: &Block,
    gone: Handle<GlobalVariable>,
    discarding: &BTreeSet<Handle<Function>>,
) -> Block {
    let mut made = Block::new();
    for (statement, span) in block.span_iter() {
        match statement {
            Statement::Kill => {
                let pointer = function.expressions.append(Expression::GlobalVariable(gone), Span::UNDEFINED);
                let value =
                    function.expressions.append(Expression::Literal(Literal::Bool(true)), Span::UNDEFINED);
                made.push(Statement::Store { pointer, value }, *span);
                made.append(&mut leave(function));
                // What stands behind it is never reached.
                return made;
            }
            Statement::Call { function: called, .. } if discarding.contains(called) => {
                made.push(statement.clone(), *span);
                let pointer = function.expressions.append(Expression::GlobalVariable(gone), Span::UNDEFINED);
                let before = function.expressions.len();
                let condition = function.expressions.append(Expression::Load { pointer }, Span::UNDEFINED);
                made.push(Statement::Emit(function.expressions.range_from(before)), Span::UNDEFINED);
                let accept = leave(function);
                made.push(Statement::If { condition, accept, reject: Block::new() }, Span::UNDEFINED);
            }
            Statement::Block(inner) => {
                made.push(Statement::Block(marked(function, inner, gone, discarding)), *span)
            }
            Statement::If { condition, accept, reject } => {
                let accept = marked(function, accept, gone, discarding);
                let reject = marked(function, reject, gone, discarding);
                made.push(Statement::If { condition: *condition, accept, reject }, *span);
            }
            Statement::Switch { selector, cases } => {
                let cases = cases
                    .iter()
                    .map(|case| SwitchCase {
                        body: marked(function, &case.body, gone, discarding),
                        ..case.clone()
                    })
                    .collect();
                made.push(Statement::Switch { selector: *selector, cases }, *span);
            }
            Statement::Loop { body, continuing, break_if } => {
                let body = marked(function, body, gone, discarding);
                made.push(
                    Statement::Loop { body, continuing: continuing.clone(), break_if: *break_if },
                    *span,
                );
            }
            other => made.push(other.clone(), *span),
        }
    }
    made
}

impl Body {
    fn literal(&mut self, literal: Literal) -> Handle<Expression> {
        self.append(Expression::Literal(literal))
    }

    fn binary(
        &mut self,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Handle<Expression> {
        self.emit(Expression::Binary { op, left, right })
    }

    fn load(&mut self, pointer: Handle<Expression>) -> Handle<Expression> {
        self.emit(Expression::Load { pointer })
    }

    fn store(&mut self, pointer: Handle<Expression>, value: Handle<Expression>) {
        self.block.push(Statement::Store { pointer, value }, Span::UNDEFINED);
    }

    fn call(&mut self, function: Handle<Function>, arguments: Vec<Handle<Expression>>) -> Handle<Expression> {
        let result = self.append(Expression::CallResult(function));
        self.block.push(Statement::Call { function, arguments, result: Some(result) }, Span::UNDEFINED);
        result
    }

    /// Writes a block apart.
    fn apart(&mut self, write: impl FnOnce(&mut Self)) -> Block {
        let outer = core::mem::take(&mut self.block);
        write(self);
        core::mem::replace(&mut self.block, outer)
    }

    fn when(&mut self, condition: Handle<Expression>, accept: Block, reject: Block) {
        self.block.push(Statement::If { condition, accept, reject }, Span::UNDEFINED);
    }
}

/// A function from an alpha and the other parameters to whether the fragment is kept.
fn kept(
    module: &mut Module,
    target: Handle<Function>,
    alpha: usize,
    answer: Answer,
    gone: Option<Handle<GlobalVariable>>,
) -> Handle<Function> {
    let number =
        module.types.insert(Type { name: None, inner: TypeInner::Scalar(Scalar::F32) }, Span::UNDEFINED);
    let colour = TypeInner::Vector { size: VectorSize::Quad, scalar: Scalar::F32 };
    let colour = module.types.insert(Type { name: None, inner: colour }, Span::UNDEFINED);
    let bool_type =
        module.types.insert(Type { name: None, inner: TypeInner::Scalar(Scalar::BOOL) }, Span::UNDEFINED);
    let arguments = module.functions[target].arguments.clone();
    let mut function = Function {
        name: Some("is_kept".to_owned()),
        result: Some(FunctionResult { ty: bool_type, binding: None }),
        ..Function::default()
    };
    let mut body = Body::default();
    function.arguments.push(FunctionArgument { name: Some(ALPHA.to_owned()), ty: number, binding: None });
    let given = body.append(Expression::FunctionArgument(0));
    if let Some(gone) = gone {
        let (pointer, value) =
            (body.append(Expression::GlobalVariable(gone)), body.literal(Literal::Bool(false)));
        body.store(pointer, value);
    }
    let mut handed = Vec::new();
    let mut written = None;
    for (index, argument) in arguments.into_iter().enumerate() {
        let base = match module.types[argument.ty].inner {
            TypeInner::Pointer { base, space: AddressSpace::Function } => Some(base),
            _ => None,
        };
        let ty = base.unwrap_or(argument.ty);
        let value = if index == alpha {
            if ty == number {
                given
            } else {
                let one = body.literal(Literal::F32(1.0));
                body.emit(Expression::Compose { ty: colour, components: vec![one, one, one, given] })
            }
        } else {
            function.arguments.push(FunctionArgument { name: argument.name.clone(), ty, binding: None });
            body.append(Expression::FunctionArgument(function.arguments.len() as u32 - 1))
        };
        if base.is_none() {
            handed.push(value);
            continue;
        }
        let variable = LocalVariable { name: argument.name, ty, init: None };
        let variable = function.local_variables.append(variable, Span::UNDEFINED);
        let pointer = body.append(Expression::LocalVariable(variable));
        body.store(pointer, value);
        if index == alpha {
            written = Some((pointer, ty == colour));
        }
        handed.push(pointer);
    }
    let result = match answer {
        Answer::Bool | Answer::Returned { .. } => Some(body.call(target, handed)),
        Answer::Written | Answer::Discards => {
            body.block
                .push(Statement::Call { function: target, arguments: handed, result: None }, Span::UNDEFINED);
            None
        }
    };
    let is_above = |body: &mut Body, value: Handle<Expression>, is_colour: bool| {
        let value =
            if is_colour { body.emit(Expression::AccessIndex { base: value, index: 3 }) } else { value };
        let zero = body.literal(Literal::F32(0.0));
        body.binary(BinaryOperator::Greater, value, zero)
    };
    let mut is_kept = match (answer, result, written) {
        (Answer::Bool, Some(result), _) => result,
        (Answer::Returned { is_colour }, Some(result), _) => is_above(&mut body, result, is_colour),
        (Answer::Written, _, Some((pointer, is_colour))) => {
            let value = body.load(pointer);
            is_above(&mut body, value, is_colour)
        }
        _ => body.literal(Literal::Bool(true)),
    };
    if let Some(gone) = gone {
        let pointer = body.append(Expression::GlobalVariable(gone));
        let mark = body.load(pointer);
        let stays = body.emit(Expression::Unary { op: UnaryOperator::LogicalNot, expr: mark });
        is_kept = body.binary(BinaryOperator::LogicalAnd, is_kept, stays);
    }
    body.block.push(Statement::Return { value: Some(is_kept) }, Span::UNDEFINED);
    (function.expressions, function.body) = (body.expressions, body.block);
    module.functions.append(function, Span::UNDEFINED)
}

/// The function that halves.
fn halving(module: &mut Module, target: Handle<Function>, kept: Handle<Function>) -> Handle<Function> {
    let number =
        module.types.insert(Type { name: None, inner: TypeInner::Scalar(Scalar::F32) }, Span::UNDEFINED);
    let word =
        module.types.insert(Type { name: None, inner: TypeInner::Scalar(Scalar::U32) }, Span::UNDEFINED);
    let mut function = Function {
        name: module.functions[target].name.clone(),
        arguments: module.functions[kept].arguments[1..].to_vec(),
        result: Some(FunctionResult { ty: number, binding: None }),
        ..Function::default()
    };
    let mut body = Body::default();
    let others: Vec<_> = (0..function.arguments.len())
        .map(|index| body.append(Expression::FunctionArgument(index as u32)))
        .collect();
    let mut local = |name: &str, value: u32, body: &mut Body| {
        let init = Some(body.literal(Literal::U32(value)));
        let variable = LocalVariable { name: Some(name.to_owned()), ty: word, init };
        let variable = function.local_variables.append(variable, Span::UNDEFINED);
        body.append(Expression::LocalVariable(variable))
    };
    let [below, above, step] =
        [("below", 0), ("above", ONE), ("step", 0)].map(|(name, value)| local(name, value, &mut body));
    let answer = |body: &mut Body, alpha: Handle<Expression>| {
        let handed = [alpha].into_iter().chain(others.iter().copied()).collect();
        body.call(kept, handed)
    };
    let number_of = |body: &mut Body, bits: Handle<Expression>| {
        body.emit(Expression::As { expr: bits, kind: ScalarKind::Float, convert: None })
    };
    let (zero, one) = (body.literal(Literal::F32(0.0)), body.literal(Literal::F32(1.0)));
    let at_zero = answer(&mut body, zero);
    let at_one = answer(&mut body, one);
    let counted = |body: &mut Body, most: u32, write: &mut dyn FnMut(&mut Body, Handle<Expression>)| {
        let inner = body.apart(|body| {
            let now = body.load(step);
            let most = body.literal(Literal::U32(most));
            let ends = body.binary(BinaryOperator::GreaterEqual, now, most);
            let leave = Block::from_vec(vec![Statement::Break]);
            body.when(ends, leave, Block::new());
            let one = body.literal(Literal::U32(1));
            let next = body.binary(BinaryOperator::Add, now, one);
            body.store(step, next);
            write(body, next);
        });
        body.block
            .push(Statement::Loop { body: inner, continuing: Block::new(), break_if: None }, Span::UNDEFINED);
    };
    counted(&mut body, HALVINGS, &mut |body, _| {
        let (a, b) = (body.load(below), body.load(above));
        let sum = body.binary(BinaryOperator::Add, a, b);
        let one = body.literal(Literal::U32(1));
        let middle = body.binary(BinaryOperator::ShiftRight, sum, one);
        let alpha = number_of(body, middle);
        let found = answer(body, alpha);
        let is_above = body.binary(BinaryOperator::Equal, found, at_one);
        let (accept, reject) =
            (body.apart(|body| body.store(above, middle)), body.apart(|body| body.store(below, middle)));
        body.when(is_above, accept, reject);
    });
    // The same answer everywhere: all are kept from 0 on, or none up to 1.
    let same = body.binary(BinaryOperator::Equal, at_zero, at_one);
    let accept = body.apart(|body| {
        let (first, last) = (body.literal(Literal::U32(0)), body.literal(Literal::U32(ONE + 1)));
        let bits = body.emit(Expression::Select { condition: at_one, accept: first, reject: last });
        body.store(above, bits);
    });
    body.when(same, accept, Block::new());
    let bits = body.load(above);
    let threshold = number_of(&mut body, bits);
    let none = body.literal(Literal::U32(0));
    body.store(step, none);
    counted(&mut body, PROBES - 1, &mut |body, count| {
        let count = body.emit(Expression::As { expr: count, kind: ScalarKind::Float, convert: Some(4) });
        let all = body.literal(Literal::F32(1.0 / PROBES as f32));
        let alpha = body.binary(BinaryOperator::Multiply, count, all);
        let found = answer(body, alpha);
        let is_as_above = body.binary(BinaryOperator::Equal, found, at_one);
        let is_above = body.binary(BinaryOperator::GreaterEqual, alpha, threshold);
        // Where no alpha is kept, the answer is that at one, too.
        let expected = body.binary(BinaryOperator::LogicalOr, is_above, same);
        let differs = body.binary(BinaryOperator::NotEqual, is_as_above, expected);
        let accept = body.apart(|body| {
            let nan = body.literal(Literal::U32(NAN));
            body.store(below, nan);
            body.store(above, nan);
        });
        body.when(differs, accept, Block::new());
    });
    let bits = body.load(above);
    let value = Some(number_of(&mut body, bits));
    body.block.push(Statement::Return { value }, Span::UNDEFINED);
    (function.expressions, function.body) = (body.expressions, body.block);
    let place = module.functions.get_span(target);
    module.functions.append(function, place)
}
