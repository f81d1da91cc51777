//! Parameters that are copied: a compiler of GLSL makes a pointer of each, to a variable of the caller.

use super::body::Body;
use naga::{AddressSpace, Expression, Function, Handle, LocalVariable, Module, Span, Statement, TypeInner};

/// Wraps `target` in a function that takes the values in the place of pointers to local variables; returns `target` where
/// it has none.
pub(super) fn wrap(module: &mut Module, target: Handle<Function>) -> Handle<Function> {
    let called = &module.functions[target];
    let mut function = Function {
        arguments: called.arguments.clone(),
        result: called.result.clone(),
        ..Function::default()
    };
    let mut body = Body::default();
    let mut handed = Vec::new();
    for (index, argument) in function.arguments.iter_mut().enumerate() {
        let value = body.append(Expression::FunctionArgument(index as u32));
        let pointer = match module.types[argument.ty].inner {
            TypeInner::Pointer { base, space: AddressSpace::Function } => {
                argument.ty = base;
                let variable = LocalVariable { name: argument.name.clone(), ty: base, init: None };
                let variable = function.local_variables.append(variable, Span::UNDEFINED);
                let pointer = body.append(Expression::LocalVariable(variable));
                body.block.push(Statement::Store { pointer, value }, Span::UNDEFINED);
                pointer
            }
            _ => value,
        };
        handed.push(pointer);
    }
    if function.local_variables.is_empty() {
        return target;
    }
    body.return_call(target, handed);
    (function.expressions, function.body) = (body.expressions, body.block);
    let place = module.functions.get_span(target);
    module.functions.append(function, place)
}
