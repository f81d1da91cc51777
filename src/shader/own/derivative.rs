//! Screen derivatives of the position, taken by name: there is no neighbouring pixel here, but each fragment brings
//! them along. This is the short way, which costs nothing; [`quads`](super::quads) takes those of anything else.

use super::body::Body;
use super::error::Fault;
use super::options::Options;
use super::scan::Token;
use super::usual;
use naga::{
    Arena, Expression, Function, FunctionArgument, FunctionResult, GlobalVariable, Handle, Module, Span,
    Statement, Type, TypeInner, VectorSize,
};
use std::collections::BTreeSet;

/// The names of the variables that take the place of derivatives: along x, along y, and the sum of both without signs. They are
/// no longer than `dFdx(p`, and none of the text's own.
pub(super) type Variables = [String; 3];

/// Declares the variables in GLSL; goes before the text.
pub(super) fn glsl(variables: &Variables) -> String {
    format!("vec3 {};\n", variables.join(", "))
}

/// Declares the variables in WGSL; goes behind the text.
pub(super) fn wgsl(variables: &Variables) -> String {
    variables.iter().map(|name| format!("\nvar<private> {name}: vec3<f32>;")).collect::<String>() + "\n"
}

/// Replaces `dFdx(position)` and its kin in the body of `function` by a variable, byte for byte, so that all else
/// keeps its place; `position` is what the text calls it. Returns the variables where there was any.
///
/// All others stay as they are, and so does each one of a position that the function changes.
pub(super) fn replace(
    text: &mut [u8],
    tokens: &[Token],
    function: &str,
    position: Option<&str>,
) -> Option<Variables> {
    let position = position?.as_bytes();
    // The first ones are for the text itself.
    let mut spare = spare_names(tokens, text).rev();
    let variables: Variables = [spare.next()?, spare.next()?, spare.next()?];
    if is_changed(text, tokens, function, position) {
        return None;
    }
    let mut found = false;
    for (index, token) in tokens.iter().enumerate() {
        let word = |at: usize| tokens.get(at).map_or(&b""[..], |token| &text[token.at.clone()]);
        let variable = match word(index) {
            b"dFdx" | b"dpdx" | b"dFdxFine" | b"dpdxFine" | b"dFdxCoarse" | b"dpdxCoarse" => &variables[0],
            b"dFdy" | b"dpdy" | b"dFdyFine" | b"dpdyFine" | b"dFdyCoarse" | b"dpdyCoarse" => &variables[1],
            b"fwidth" | b"fwidthFine" | b"fwidthCoarse" => &variables[2],
            _ => continue,
        };
        let close = match (word(index + 1), word(index + 2), word(index + 3)) {
            (b"(", argument, b")") if argument == position => index + 3,
            (b"(", argument, b".") if argument == position && word(index + 5) == b")" => index + 5,
            _ => continue,
        };
        if token.function.is_none_or(|name| word(name) != function.as_bytes()) {
            continue;
        }
        let (start, argument) = (token.at.start, tokens[index + 2].at.end);
        text[start..argument].fill(b' ');
        text[start..start + variable.len()].copy_from_slice(variable.as_bytes());
        text[tokens[close].at.clone()].fill(b' ');
        found = true;
    }
    found.then_some(variables)
}

/// Whether the body of a function may give a name another value, itself or by `inout`: then its derivative is another, too.
fn is_changed(text: &[u8], tokens: &[Token], function: &str, name: &[u8]) -> bool {
    let word = |at: usize| tokens.get(at).map_or(&b""[..], |token| &text[token.at.clone()]);
    let is_within = |token: &Token| {
        token.function.is_some_and(|function_name| word(function_name) == function.as_bytes())
    };
    let hands_out = tokens.iter().any(|token| matches!(&text[token.at.clone()], b"inout" | b"out"));
    tokens.iter().enumerate().filter(|(_, token)| is_within(token)).any(|(at, token)| {
        let behind = if word(at + 1) == b"." { at + 3 } else { at + 1 };
        let is_operator = matches!(word(behind), b"+" | b"-" | b"*" | b"/");
        let assigned = match (word(behind), word(behind + 1)) {
            (b"=", next) => next != b"=",
            (b"[", _) => true,
            (sign, next) => is_operator && (next == b"=" || (sign == next && matches!(sign, b"+" | b"-"))),
        };
        let stands_alone = matches!(word(behind), b"," | b")") && token.parentheses > 0;
        text[token.at.clone()] == *name && (assigned || hands_out && stands_alone)
    })
}

/// Names of two letters that a text does not use.
pub(super) fn spare_names(tokens: &[Token], text: &[u8]) -> impl DoubleEndedIterator<Item = String> + use<> {
    let is_short = |token: &&Token| token.at.len() == 2 && text[token.at.start] == b'_';
    let used: BTreeSet<u8> = tokens.iter().filter(is_short).map(|token| text[token.at.start + 1]).collect();
    let letters = (b'a'..=b'z').chain(b'A'..=b'Z').filter(move |letter| !used.contains(letter));
    letters.map(|letter| format!("_{}", char::from(letter)))
}

/// What a text calls the position: a vector of three among the parameters of the function that is asked for, or one that comes from
/// the stage before. Nothing where that is not certain before it is parsed.
pub(super) fn position<'t>(text: &'t str, tokens: &[Token], asked: &Options) -> Option<&'t str> {
    let word = |index: usize| tokens.get(index).map_or("", |token| &text[token.at.clone()]);
    let is_vector = |index: usize| matches!(word(index), "vec3" | "vec3f" | "float3");
    let name = tokens.iter().find_map(|token| token.function.filter(|&name| word(name) == asked.function));
    let end = |start: usize| (start..tokens.len()).find(|&at| word(at) == "{").unwrap_or(start);
    let parameters = name.into_iter().flat_map(|start| start..end(start)).filter(|&at| is_vector(at));
    // `vec3 p` or `p: vec3<f32>`.
    let named = |at: usize| if word(at - 1) == ":" { word(at - 2) } else { word(at + 1) };
    let parameters: Vec<_> = parameters.filter(|&at| at > 1).map(named).collect();
    let is_input = |at: &usize| tokens[*at].function.is_none() && matches!(word(at - 1), "in" | "varying");
    let inputs: Vec<_> = (1..tokens.len()).filter(|&at| is_vector(at)).filter(is_input).map(named).collect();
    usual::position_among(&parameters, asked).or_else(|| usual::position_among(&inputs, asked))
}

/// Refuses the derivatives that are left in a module of nothing but what the function on trial comes to, beside something that
/// [`quads`](super::quads) does not know; `its_name` is that of the function in the module, `function` what the user calls it.
///
/// # Errors
///
/// A derivative of anything but the position, or elsewhere: its value is not known.
pub(super) fn refuse_others(module: &Module, its_name: &str, function: &str) -> Result<(), Fault> {
    for (_, within) in module.functions.iter() {
        let place = |expression| within.expressions.get_span(expression).to_range();
        let derivatives = within.expressions.iter().filter_map(|(at, expression)| match *expression {
            // The front end of GLSL knows the place of the argument alone.
            Expression::Derivative { expr, .. } => Some(place(at).or_else(|| place(expr))),
            _ => None,
        });
        let Some(at) = derivatives.min_by_key(|at| at.clone().map_or(0, |at| at.start)) else { continue };
        let message = if within.name.as_deref() == Some(its_name) {
            format!(
                "only the derivatives of `position` are known here, written out in the body of `{function}`; for those of \
                 anything else add a parameter and give it a value"
            )
        } else {
            format!(
                "a derivative is known in the body of `{function}` only; hand it to other functions as a parameter"
            )
        };
        return Err(Fault::new(message).at(at));
    }
    Ok(())
}

/// Wraps `target` in a function that takes the derivatives as parameters `dpdx` and `dpdy` and fills the variables.
pub(super) fn wrap(module: &mut Module, target: Handle<Function>, variables: &Variables) -> Handle<Function> {
    let vector = module.types.insert(
        Type { name: None, inner: TypeInner::Vector { size: VectorSize::Tri, scalar: naga::Scalar::F32 } },
        Span::UNDEFINED,
    );
    let called = &module.functions[target];
    let mut function = Function {
        arguments: called.arguments.clone(),
        result: called.result.clone(),
        ..Function::default()
    };
    let own_arguments = function.arguments.len();
    let [dx, dy] = parameters(&mut function.arguments, vector);
    let mut body = Body::default();
    let arguments: Vec<_> = (0..function.arguments.len())
        .map(|index| body.append(Expression::FunctionArgument(index as u32)))
        .collect();
    let width = {
        let absolute = [arguments[dx], arguments[dy]].map(|arg| {
            let (fun, arg1, arg2, arg3) = (naga::MathFunction::Abs, None, None, None);
            body.emit(Expression::Math { fun, arg, arg1, arg2, arg3 })
        });
        body.emit(Expression::Binary { op: naga::BinaryOperator::Add, left: absolute[0], right: absolute[1] })
    };
    for (name, value) in variables.iter().zip([arguments[dx], arguments[dy], width]) {
        if let Some(variable) = find(&module.global_variables, name) {
            let pointer = body.append(Expression::GlobalVariable(variable));
            body.block.push(Statement::Store { pointer, value }, Span::UNDEFINED);
        }
    }
    body.return_call(target, arguments[..own_arguments].to_vec());
    (function.expressions, function.body) = (body.expressions, body.block);
    function.result = function.result.map(|FunctionResult { ty, .. }| FunctionResult { ty, binding: None });
    module.functions.append(function, Span::UNDEFINED)
}

/// Returns which parameters are `dpdx` and `dpdy`; appends those that are not there.
pub(super) fn parameters(arguments: &mut Vec<FunctionArgument>, vector: Handle<Type>) -> [usize; 2] {
    ["dpdx", "dpdy"].map(|name| {
        let found = arguments.iter().position(|argument| argument.name.as_deref() == Some(name));
        found.unwrap_or_else(|| {
            arguments.push(FunctionArgument { name: Some(name.to_owned()), ty: vector, binding: None });
            arguments.len() - 1
        })
    })
}

fn find(variables: &Arena<GlobalVariable>, name: &str) -> Option<Handle<GlobalVariable>> {
    variables.iter().find(|(_, variable)| variable.name.as_deref() == Some(name)).map(|(handle, _)| handle)
}
