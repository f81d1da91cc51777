//! Derivatives of anything that a function computes, wherever it takes them.
//!
//! A device runs four pixels side by side and takes differences. Here each value brings along how much larger it is one pixel further
//! right and one further down: of a sum that is the sum of those of its terms, of a product its own rule, and of any other function
//! f(x + dx) - f(x). So the difference of what is linear in the position is exact however far from the origin it lies, where the
//! positions of two pixels round to one, and that of a step is a step, as on a device. Both pixels are taken to go the same way through
//! branches and loops.

use super::body::Body;
use super::derivative;
use super::invalid::called_by;
use super::signature;
use super::variables::written_by;
use super::waiting::reached_from;
use naga::front::Typifier;
use naga::proc::ResolveContext;
use naga::{
    AddressSpace, BinaryOperator, Block, DerivativeAxis, Expression, Function, FunctionArgument,
    FunctionResult, GlobalVariable, Handle, Literal, LocalVariable, MathFunction, Module, ScalarKind, Span,
    Statement, SwitchCase, Type, TypeInner, UnaryOperator,
};
use std::collections::BTreeMap;

/// Along screen x and along screen y.
const AXES: usize = 2;

/// A function that knows the differences of its parameters.
struct Twin {
    function: Handle<Function>,
    /// Which parameters of the first one have differences; they stand behind all of its own, those along x first.
    has_difference: Vec<bool>,
    /// Where it leaves those of its result.
    result: Option<[Handle<GlobalVariable>; AXES]>,
}

/// Puts a function that takes no derivatives in the place of `target`, where that takes any: it has `dpdx` and `dpdy` among its
/// parameters. What is not understood here is refused elsewhere, in words of its own.
pub(super) fn wrap(module: &mut Module, target: Handle<Function>) -> Handle<Function> {
    let reached = reached_from(module, target);
    let takes_any = reached.iter().any(|&function| {
        let mut expressions = module.functions[function].expressions.iter();
        expressions.any(|(_, expression)| matches!(expression, Expression::Derivative { .. }))
    });
    if !takes_any {
        return target;
    }
    let mut changed = module.clone();
    let Some(twin) = twins(&mut changed, target) else { return target };
    *module = changed;
    call(module, target, &twin)
}

/// Writes the twins of a function and of all that it calls.
fn twins(module: &mut Module, target: Handle<Function>) -> Option<Twin> {
    let mut order = Vec::new();
    called_first(module, target, &mut order);
    let written: Vec<_> =
        order.iter().flat_map(|&function| written_by(&module.functions[function])).collect();
    let mut globals = BTreeMap::new();
    for handle in written {
        let variable = &module.global_variables[handle];
        if variable.space == AddressSpace::Private
            && has_floats(module, variable.ty)
            && !globals.contains_key(&handle)
        {
            let ty = variable.ty;
            globals.insert(handle, core::array::from_fn(|_| private(module, ty)));
        }
    }
    let mut twins = BTreeMap::new();
    for function in order {
        let twin = Writer::new(module, function, &globals, &twins).write()?;
        twins.insert(function, twin);
    }
    twins.remove(&target)
}

/// Lists a function and all that it calls, what is called before what calls it.
fn called_first(module: &Module, function: Handle<Function>, order: &mut Vec<Handle<Function>>) {
    if !order.contains(&function) {
        for called in called_by(&module.functions[function].body) {
            called_first(module, called, order);
        }
        if !order.contains(&function) {
            order.push(function);
        }
    }
}

/// A variable of the module that begins with zero.
fn private(module: &mut Module, ty: Handle<Type>) -> Handle<GlobalVariable> {
    let init = Some(module.global_expressions.append(Expression::ZeroValue(ty), Span::UNDEFINED));
    let variable = GlobalVariable {
        name: Some("difference".to_owned()),
        space: AddressSpace::Private,
        binding: None,
        ty,
        init,
        memory_decorations: naga::MemoryDecorations::empty(),
    };
    module.global_variables.append(variable, Span::UNDEFINED)
}

/// Whether values of a type, or what pointers of it lead to, have floats in them.
fn has_floats(module: &Module, ty: Handle<Type>) -> bool {
    match module.types[ty].inner {
        TypeInner::Array { base, .. } => has_floats(module, base),
        TypeInner::Pointer { base, space } => {
            matches!(space, AddressSpace::Function | AddressSpace::Private) && has_floats(module, base)
        }
        TypeInner::Struct { ref members, .. } => members.iter().any(|member| has_floats(module, member.ty)),
        ref inner => is_float(inner),
    }
}

/// Whether it is a number, a vector or a matrix of floats.
const fn is_float(inner: &TypeInner) -> bool {
    match *inner {
        TypeInner::Scalar(scalar) | TypeInner::Vector { scalar, .. } | TypeInner::Matrix { scalar, .. } => {
            matches!(scalar.kind, ScalarKind::Float)
        }
        _ => false,
    }
}

/// Calls a twin with the differences that a fragment has: those of the position, one pixel along each axis, and of texture coordinates
/// as many units as the position moves by.
fn call(module: &mut Module, target: Handle<Function>, twin: &Twin) -> Handle<Function> {
    let vector = module.types.insert(signature::type_of("dpdx"), Span::UNDEFINED);
    let called = &module.functions[target];
    let mut function = Function {
        arguments: called.arguments.clone(),
        result: called.result.clone().map(|FunctionResult { ty, .. }| FunctionResult { ty, binding: None }),
        ..Function::default()
    };
    let own = function.arguments.clone();
    let derivatives = derivative::parameters(&mut function.arguments, vector);
    let mut body = Body::default();
    let argument = |body: &mut Body, index: usize| body.append(Expression::FunctionArgument(index as u32));
    let mut handed: Vec<_> = (0..own.len()).map(|index| argument(&mut body, index)).collect();
    for (axis, &derivative) in derivatives.iter().enumerate() {
        let with = own.iter().zip(&twin.has_difference).filter(|(_, has_difference)| **has_difference);
        for (of, _) in with {
            handed.push(match of.name.as_deref() {
                Some("position") => argument(&mut body, derivative),
                Some(of_plane @ ("pixel" | "texcoord")) => {
                    let size = if of_plane == "pixel" {
                        body.append(Expression::Literal(Literal::F32(1.0)))
                    } else {
                        // A unit of the texture is taken for a unit of the surface.
                        let arg = argument(&mut body, derivative);
                        let fun = MathFunction::Length;
                        body.emit(Expression::Math { fun, arg, arg1: None, arg2: None, arg3: None })
                    };
                    let none = body.append(Expression::Literal(Literal::F32(0.0)));
                    let components = if axis == 0 { vec![size, none] } else { vec![none, size] };
                    body.emit(Expression::Compose { ty: of.ty, components })
                }
                _ => body.append(Expression::ZeroValue(of.ty)),
            });
        }
    }
    body.return_call(twin.function, handed);
    (function.expressions, function.body) = (body.expressions, body.block);
    let place = module.functions.get_span(target);
    module.functions.append(function, place)
}

/// Writes the twin of one function.
struct Writer<'w> {
    module: &'w mut Module,
    globals: &'w BTreeMap<Handle<GlobalVariable>, [Handle<GlobalVariable>; AXES]>,
    twins: &'w BTreeMap<Handle<Function>, Twin>,
    old: Function,
    place: Span,
    types: Typifier,
    new: Function,
    block: Block,
    has_difference: Vec<bool>,
    result: Option<[Handle<GlobalVariable>; AXES]>,
    locals: BTreeMap<Handle<LocalVariable>, [Handle<LocalVariable>; AXES]>,
    /// By what the first function calls them.
    values: BTreeMap<Handle<Expression>, Handle<Expression>>,
    /// Differences; those of pointers lead to the variable that holds them.
    differences: [BTreeMap<Handle<Expression>, Handle<Expression>>; AXES],
}

impl<'w> Writer<'w> {
    fn new(
        module: &'w mut Module,
        function: Handle<Function>,
        globals: &'w BTreeMap<Handle<GlobalVariable>, [Handle<GlobalVariable>; AXES]>,
        twins: &'w BTreeMap<Handle<Function>, Twin>,
    ) -> Self {
        let old = module.functions[function].clone();
        let place = module.functions.get_span(function);
        let has_difference: Vec<_> =
            old.arguments.iter().map(|argument| has_floats(module, argument.ty)).collect();
        let mut new = Function { name: old.name.clone(), result: old.result.clone(), ..Function::default() };
        new.arguments.clone_from(&old.arguments);
        for _ in 0..AXES {
            let with =
                old.arguments.iter().zip(&has_difference).filter(|(_, has_difference)| **has_difference);
            new.arguments
                .extend(with.map(|(argument, _)| FunctionArgument { name: None, ..argument.clone() }));
        }
        let returned = old.result.as_ref().map(|result| result.ty).filter(|&ty| has_floats(module, ty));
        let result = returned.map(|ty| core::array::from_fn(|_| private(module, ty)));
        Self {
            module,
            globals,
            twins,
            old,
            place,
            types: Typifier::new(),
            new,
            block: Block::default(),
            has_difference,
            result,
            locals: BTreeMap::new(),
            values: BTreeMap::new(),
            differences: [BTreeMap::new(), BTreeMap::new()],
        }
    }

    /// Nothing where something is in it that has no twin.
    fn write(mut self) -> Option<Twin> {
        let context =
            ResolveContext::with_locals(self.module, &self.old.local_variables, &self.old.arguments);
        for (handle, _) in self.old.expressions.iter() {
            self.types.grow(handle, &self.old.expressions, &context).ok()?;
        }
        self.declare()?;
        let body = core::mem::take(&mut self.old.body);
        self.new.body = self.within(&body)?;
        let function = self.module.functions.append(self.new, self.place);
        Some(Twin { function, has_difference: self.has_difference, result: self.result })
    }

    /// Takes over what needs no place in the body: variables, parameters and constants.
    fn declare(&mut self) -> Option<()> {
        let variables: Vec<_> =
            self.old.local_variables.iter().map(|(at, variable)| (at, variable.clone())).collect();
        let mut moved = BTreeMap::new();
        for (at, variable) in variables {
            let init = match variable.init {
                Some(init) => Some(self.constant(init)?),
                None => None,
            };
            let (ty, place) = (variable.ty, self.old.local_variables.get_span(at));
            moved.insert(at, self.new.local_variables.append(LocalVariable { init, ..variable }, place));
            if has_floats(self.module, ty) {
                let shadow = LocalVariable { name: None, ty, init: None };
                let shadows = core::array::from_fn(|_| {
                    self.new.local_variables.append(shadow.clone(), Span::UNDEFINED)
                });
                self.locals.insert(at, shadows);
            }
        }
        let all: Vec<_> =
            self.old.expressions.iter().map(|(at, expression)| (at, expression.clone())).collect();
        for (at, expression) in all.into_iter().filter(|(_, expression)| expression.needs_pre_emit()) {
            let expression = match expression {
                Expression::LocalVariable(variable) => Expression::LocalVariable(moved[&variable]),
                other => other,
            };
            for axis in 0..AXES {
                let difference = match self.old.expressions[at] {
                    Expression::LocalVariable(variable) => {
                        self.locals.get(&variable).map(|shadows| Expression::LocalVariable(shadows[axis]))
                    }
                    Expression::GlobalVariable(variable) => {
                        self.globals.get(&variable).map(|shadows| Expression::GlobalVariable(shadows[axis]))
                    }
                    Expression::FunctionArgument(index) => self.argument(index as usize, axis),
                    _ => None,
                };
                if let Some(difference) = difference {
                    let difference = self.new.expressions.append(difference, Span::UNDEFINED);
                    self.differences[axis].insert(at, difference);
                }
            }
            let value = self.new.expressions.append(expression, self.old.expressions.get_span(at));
            self.values.insert(at, value);
        }
        Some(())
    }

    /// The parameter that brings the difference of one.
    fn argument(&self, index: usize, axis: usize) -> Option<Expression> {
        let count = |of: &[bool]| of.iter().filter(|has_difference| **has_difference).count();
        let place = self.has_difference.len()
            + axis * count(&self.has_difference)
            + count(&self.has_difference[..index]);
        self.has_difference[index].then_some(Expression::FunctionArgument(place as u32))
    }

    /// Takes over an initial value, which is no part of the body.
    fn constant(&mut self, at: Handle<Expression>) -> Option<Handle<Expression>> {
        let expression = match self.old.expressions[at].clone() {
            Expression::Compose { ty, components } => {
                let components = components.into_iter().map(|component| self.constant(component));
                Expression::Compose { ty, components: components.collect::<Option<_>>()? }
            }
            Expression::Splat { size, value } => Expression::Splat { size, value: self.constant(value)? },
            plain if plain.needs_pre_emit() => plain,
            _ => return None,
        };
        Some(self.new.expressions.append(expression, self.old.expressions.get_span(at)))
    }

    /// Writes a block with all that is in it.
    fn within(&mut self, block: &Block) -> Option<Block> {
        let outer = core::mem::take(&mut self.block);
        for (statement, span) in block.span_iter() {
            self.statement(statement, *span)?;
        }
        Some(core::mem::replace(&mut self.block, outer))
    }

    fn statement(&mut self, statement: &Statement, span: Span) -> Option<()> {
        let written = match *statement {
            Statement::Emit(ref range) => {
                for at in range.clone() {
                    self.expression(at)?;
                }
                return Some(());
            }
            Statement::Block(ref inner) => Statement::Block(self.within(inner)?),
            Statement::If { condition, ref accept, ref reject } => {
                let (condition, accept) = (self.value(condition)?, self.within(accept)?);
                Statement::If { condition, accept, reject: self.within(reject)? }
            }
            Statement::Switch { selector, ref cases } => {
                let selector = self.value(selector)?;
                let case =
                    |case: &SwitchCase| Some(SwitchCase { body: self.within(&case.body)?, ..case.clone() });
                Statement::Switch { selector, cases: cases.iter().map(case).collect::<Option<_>>()? }
            }
            Statement::Loop { ref body, ref continuing, break_if } => {
                let (body, continuing) = (self.within(body)?, self.within(continuing)?);
                let break_if = match break_if {
                    Some(condition) => Some(self.value(condition)?),
                    None => None,
                };
                Statement::Loop { body, continuing, break_if }
            }
            Statement::Break => Statement::Break,
            Statement::Continue => Statement::Continue,
            Statement::Kill => Statement::Kill,
            Statement::Return { value } => {
                let value = match value {
                    Some(value) => {
                        for axis in 0..AXES {
                            if let Some(globals) = self.result {
                                let difference = self.difference_or_zero(value, axis);
                                let place = Expression::GlobalVariable(globals[axis]);
                                let pointer = self.new.expressions.append(place, Span::UNDEFINED);
                                self.block.push(Statement::Store { pointer, value: difference }, span);
                            }
                        }
                        Some(self.value(value)?)
                    }
                    None => None,
                };
                Statement::Return { value }
            }
            Statement::Store { pointer, value } => {
                for axis in 0..AXES {
                    if let Some(&shadow) = self.differences[axis].get(&pointer) {
                        let difference = self.difference_or_zero(value, axis);
                        self.block.push(Statement::Store { pointer: shadow, value: difference }, span);
                    }
                }
                Statement::Store { pointer: self.value(pointer)?, value: self.value(value)? }
            }
            Statement::Call { function, ref arguments, result } => {
                return self.call(function, arguments, result, span);
            }
            _ => return None,
        };
        self.block.push(written, span);
        Some(())
    }

    fn call(
        &mut self,
        function: Handle<Function>,
        arguments: &[Handle<Expression>],
        result: Option<Handle<Expression>>,
        span: Span,
    ) -> Option<()> {
        let twin = self.twins.get(&function)?;
        let mut handed =
            arguments.iter().map(|&argument| self.value(argument)).collect::<Option<Vec<_>>>()?;
        for axis in 0..AXES {
            for (&argument, _) in arguments.iter().zip(&twin.has_difference).filter(|(_, has)| **has) {
                let is_pointer = self.inner(argument).pointer_space().is_some();
                if is_pointer && !self.differences[axis].contains_key(&argument) {
                    return None;
                }
                handed.push(self.difference_or_zero(argument, axis));
            }
        }
        let value = result.map(|_| self.new.expressions.append(Expression::CallResult(twin.function), span));
        self.block.push(Statement::Call { function: twin.function, arguments: handed, result: value }, span);
        if let (Some(at), Some(value)) = (result, value) {
            self.values.insert(at, value);
            for axis in 0..AXES {
                if let Some(globals) = twin.result {
                    let place = Expression::GlobalVariable(globals[axis]);
                    let pointer = self.new.expressions.append(place, Span::UNDEFINED);
                    let difference = self.emit(Expression::Load { pointer }, span);
                    self.differences[axis].insert(at, difference);
                }
            }
        }
        Some(())
    }

    fn value(&self, at: Handle<Expression>) -> Option<Handle<Expression>> {
        self.values.get(&at).copied()
    }

    fn inner(&self, at: Handle<Expression>) -> &TypeInner {
        self.types[at].inner_with(&self.module.types)
    }

    fn emit(&mut self, expression: Expression, span: Span) -> Handle<Expression> {
        let before = self.new.expressions.len();
        let at = self.new.expressions.append(expression, span);
        self.block.push(Statement::Emit(self.new.expressions.range_from(before)), span);
        at
    }

    /// The difference of a value; zero, of its type, where it has none.
    fn difference_or_zero(&mut self, at: Handle<Expression>, axis: usize) -> Handle<Expression> {
        if let Some(&difference) = self.differences[axis].get(&at) {
            return difference;
        }
        let ty = match self.types[at].handle() {
            Some(ty) => ty,
            None => {
                let inner = self.inner(at).clone();
                self.module.types.insert(Type { name: None, inner }, Span::UNDEFINED)
            }
        };
        self.new.expressions.append(Expression::ZeroValue(ty), Span::UNDEFINED)
    }

    fn expression(&mut self, at: Handle<Expression>) -> Option<()> {
        let span = self.old.expressions.get_span(at);
        let expression = self.old.expressions[at].clone();
        let value = match expression {
            Expression::Derivative { axis: DerivativeAxis::X, expr, .. } => self.difference_or_zero(expr, 0),
            Expression::Derivative { axis: DerivativeAxis::Y, expr, .. } => self.difference_or_zero(expr, 1),
            Expression::Derivative { axis: DerivativeAxis::Width, expr, .. } => {
                let both = [0, 1].map(|axis| {
                    let arg = self.difference_or_zero(expr, axis);
                    let (fun, arg1, arg2, arg3) = (MathFunction::Abs, None, None, None);
                    self.emit(Expression::Math { fun, arg, arg1, arg2, arg3 }, span)
                });
                self.binary(BinaryOperator::Add, both[0], both[1])
            }
            _ => {
                let moved = self.moved(&expression, &|writer, part| writer.value(part))?;
                self.emit(moved, span)
            }
        };
        self.values.insert(at, value);
        for axis in 0..AXES {
            if let Some(difference) = self.difference(at, &expression, axis) {
                self.differences[axis].insert(at, difference);
            }
        }
        Some(())
    }

    /// The same expression of other parts.
    fn moved(
        &self,
        expression: &Expression,
        part: &impl Fn(&Self, Handle<Expression>) -> Option<Handle<Expression>>,
    ) -> Option<Expression> {
        let of = |at| part(self, at);
        let if_any = |at: Option<_>| match at {
            Some(at) => of(at).map(Some),
            None => Some(None),
        };
        Some(match *expression {
            Expression::Compose { ty, ref components } => Expression::Compose {
                ty,
                components: components.iter().map(|&at| of(at)).collect::<Option<_>>()?,
            },
            Expression::Access { base, index } => {
                Expression::Access { base: of(base)?, index: self.value(index)? }
            }
            Expression::AccessIndex { base, index } => Expression::AccessIndex { base: of(base)?, index },
            Expression::Splat { size, value } => Expression::Splat { size, value: of(value)? },
            Expression::Swizzle { size, vector, pattern } => {
                Expression::Swizzle { size, vector: of(vector)?, pattern }
            }
            Expression::Load { pointer } => Expression::Load { pointer: of(pointer)? },
            Expression::Unary { op, expr } => Expression::Unary { op, expr: of(expr)? },
            Expression::Binary { op, left, right } => {
                Expression::Binary { op, left: of(left)?, right: of(right)? }
            }
            Expression::Select { condition, accept, reject } => {
                let condition = self.value(condition)?;
                Expression::Select { condition, accept: of(accept)?, reject: of(reject)? }
            }
            Expression::Relational { fun, argument } => {
                Expression::Relational { fun, argument: of(argument)? }
            }
            Expression::Math { fun, arg, arg1, arg2, arg3 } => Expression::Math {
                fun,
                arg: of(arg)?,
                arg1: if_any(arg1)?,
                arg2: if_any(arg2)?,
                arg3: if_any(arg3)?,
            },
            Expression::As { expr, kind, convert } => Expression::As { expr: of(expr)?, kind, convert },
            _ => return None,
        })
    }

    /// Writes how much larger a value is one pixel further; nothing where it is the same there.
    fn difference(
        &mut self,
        at: Handle<Expression>,
        expression: &Expression,
        axis: usize,
    ) -> Option<Handle<Expression>> {
        let span = self.old.expressions.get_span(at);
        let known = |writer: &Self, part: Handle<Expression>| writer.differences[axis].get(&part).copied();
        match *expression {
            Expression::AccessIndex { .. }
            | Expression::Access { .. }
            | Expression::Splat { .. }
            | Expression::Swizzle { .. }
            | Expression::Load { .. }
            | Expression::Unary { op: UnaryOperator::Negate, .. } => {
                let moved = self.moved(expression, &known)?;
                Some(self.emit(moved, span))
            }
            Expression::Compose { ref components, .. } => {
                components.iter().find_map(|&part| known(self, part))?;
                let zeros: BTreeMap<_, _> =
                    components.iter().map(|&part| (part, self.difference_or_zero(part, axis))).collect();
                let moved = self.moved(expression, &|_, part| zeros.get(&part).copied())?;
                Some(self.emit(moved, span))
            }
            Expression::Select { accept, reject, .. } => {
                known(self, accept).or_else(|| known(self, reject))?;
                let both = [accept, reject].map(|part| (part, self.difference_or_zero(part, axis)));
                let both = BTreeMap::from(both);
                let moved = self.moved(expression, &|_, part| both.get(&part).copied())?;
                Some(self.emit(moved, span))
            }
            Expression::As { kind: ScalarKind::Float, .. } => {
                let moved = self.moved(expression, &known)?;
                Some(self.emit(moved, span))
            }
            Expression::Binary { op, left, right } => {
                let (dl, dr) = (known(self, left), known(self, right));
                let (l, r) = (self.value(left)?, self.value(right)?);
                self.of_operator(at, op, [l, r], [dl, dr])
            }
            Expression::Math { arg, arg1, arg2, arg3, .. } if is_float(self.inner(at)) => {
                let parts = [Some(arg), arg1, arg2, arg3];
                parts.into_iter().flatten().find_map(|part| known(self, part))?;
                let mut there = BTreeMap::new();
                for part in parts.into_iter().flatten() {
                    let here = self.value(part)?;
                    let moved = known(self, part)
                        .map(|difference| self.binary(BinaryOperator::Add, here, difference));
                    there.insert(part, moved.unwrap_or(here));
                }
                let moved = self.moved(expression, &|_, part| there.get(&part).copied())?;
                let moved = self.emit(moved, span);
                Some(self.binary(BinaryOperator::Subtract, moved, self.value(at)?))
            }
            _ => None,
        }
    }

    fn of_operator(
        &mut self,
        at: Handle<Expression>,
        op: BinaryOperator,
        [l, r]: [Handle<Expression>; 2],
        [dl, dr]: [Option<Handle<Expression>>; 2],
    ) -> Option<Handle<Expression>> {
        use BinaryOperator::{Add, Divide, Modulo, Multiply, Subtract};
        if !is_float(self.inner(at)) {
            return None;
        }
        Some(match (op, dl, dr) {
            (_, None, None) => return None,
            (Add | Subtract, Some(dl), None) => dl,
            (Add, None, Some(dr)) => dr,
            (Subtract, None, Some(dr)) => {
                self.emit(Expression::Unary { op: UnaryOperator::Negate, expr: dr }, Span::UNDEFINED)
            }
            (Add | Subtract, Some(dl), Some(dr)) => self.binary(op, dl, dr),
            (Multiply, Some(dl), None) => self.binary(Multiply, dl, r),
            (Multiply, None, Some(dr)) => self.binary(Multiply, l, dr),
            (Multiply, Some(dl), Some(dr)) => {
                let first = self.binary(Multiply, dl, r);
                let there = self.binary(Add, l, dl);
                let second = self.binary(Multiply, there, dr);
                self.binary(Add, first, second)
            }
            (Divide, Some(dl), None) => self.binary(Divide, dl, r),
            (Divide, dl, Some(dr)) => {
                let quotient = self.value(at)?;
                let grown = self.binary(Multiply, quotient, dr);
                let left = match dl {
                    Some(dl) => self.binary(Subtract, dl, grown),
                    None => self
                        .emit(Expression::Unary { op: UnaryOperator::Negate, expr: grown }, Span::UNDEFINED),
                };
                let there = self.binary(Add, r, dr);
                self.binary(Divide, left, there)
            }
            (Modulo, dl, dr) => {
                let there = [(l, dl), (r, dr)]
                    .map(|(here, difference)| difference.map_or(here, |by| self.binary(Add, here, by)));
                let there = self.binary(Modulo, there[0], there[1]);
                self.binary(Subtract, there, self.value(at)?)
            }
            _ => return None,
        })
    }

    fn binary(
        &mut self,
        op: BinaryOperator,
        left: Handle<Expression>,
        right: Handle<Expression>,
    ) -> Handle<Expression> {
        self.emit(Expression::Binary { op, left, right }, Span::UNDEFINED)
    }
}
