//! A function around another one, whose parameters have the names and types of a fragment's values.

use super::body::Body;
use super::signature;
use super::usual::{PIXEL_SIZE, meanings};
use super::waiting::{Item, Place, members};
use naga::{
    AddressSpace, Expression, Function, FunctionArgument, FunctionResult, Handle, MathFunction, Module,
    ScalarKind, Span, Statement, StructMember, Type, TypeInner,
};
use std::collections::BTreeMap;

/// The number of components and the kind of a type of 32 bits.
pub(super) fn shape(inner: &TypeInner) -> Option<(usize, ScalarKind)> {
    let (size, scalar) = match *inner {
        TypeInner::Scalar(scalar) => (1, scalar),
        TypeInner::Vector { size, scalar } => (size as usize, scalar),
        _ => return None,
    };
    (scalar.width == 4).then_some((size, scalar.kind))
}

/// Whether a type is not that of a value of a fragment, and can be made out of it.
pub(super) fn is_of_another_type(module: &Module, meaning: &str, ty: Handle<Type>) -> bool {
    let is_same = shape(&module.types[ty].inner) == shape(&signature::type_of(meaning).inner);
    meaning == PIXEL_SIZE || !is_same && is_made(module, meaning, ty)
}

/// Whether [`made`] can make a type out of a value of a fragment.
pub(super) fn is_made(module: &Module, meaning: &str, ty: Handle<Type>) -> bool {
    let Some((size, kind)) = shape(&module.types[ty].inner) else { return false };
    match meaning {
        "position" => matches!(size, 3 | 4) && kind == ScalarKind::Float,
        "dpdx" | "dpdy" => size == 3 && kind == ScalarKind::Float,
        "pixel" => size >= 2 && kind == ScalarKind::Float || size == 2,
        "texcoord" => size == 2 && kind == ScalarKind::Float,
        "frame" | "layer" => size == 1,
        PIXEL_SIZE => matches!(size, 1 | 3) && kind == ScalarKind::Float,
        _ => size == 1 && kind == ScalarKind::Float,
    }
}

/// Makes a value of a type out of one of a fragment: components that it does not have are 1, but 1/2 for the depth of a pixel;
/// whole numbers and floats are converted.
fn made(
    body: &mut Body,
    module: &Module,
    meaning: &str,
    value: Handle<Expression>,
    from: Handle<Type>,
    ty: Handle<Type>,
) -> Handle<Expression> {
    let (Some((has, kind)), Some((size, wanted))) =
        (shape(&module.types[from].inner), shape(&module.types[ty].inner))
    else {
        return value;
    };
    let value = if kind == wanted {
        value
    } else {
        body.emit(Expression::As { expr: value, kind: wanted, convert: Some(4) })
    };
    if has == size {
        return value;
    }
    let mut components = vec![value];
    for index in has..size {
        let fill = if meaning == "pixel" && index == 2 { 0.5 } else { 1.0 };
        components.push(body.append(Expression::Literal(naga::Literal::F32(fill))));
    }
    body.emit(Expression::Compose { ty, components })
}

pub(super) fn wrap(
    module: &mut Module,
    target: Handle<Function>,
    taken: &[(Place, Handle<Type>, &'static str)],
    items: &[Item],
) -> Handle<Function> {
    let types: BTreeMap<&str, Handle<Type>> = meanings()
        .filter(|&meaning| meaning != PIXEL_SIZE)
        .map(|meaning| (meaning, module.types.insert(signature::type_of(meaning), Span::UNDEFINED)))
        .collect();
    let result = module.functions[target].result.clone();
    let mut wrapper =
        Wrapper { types, function: Function { result, ..Function::default() }, body: Body::default() };
    let meaning = |place: Place| {
        taken.iter().find(|(other, ..)| *other == place).map(|&(_, ty, meaning)| (ty, meaning))
    };
    let mut handed = Vec::new();
    for (index, argument) in module.functions[target].arguments.clone().into_iter().enumerate() {
        let Some(members) = members(module, argument.ty).map(<[StructMember]>::to_vec) else {
            handed.push(match meaning(Place::Parameter(index)) {
                Some((ty, meaning)) => wrapper.value(module, meaning, ty),
                None => wrapper.parameter(argument.name, argument.ty),
            });
            continue;
        };
        let parts = members.into_iter().enumerate().map(|(member, StructMember { name, ty, .. })| {
            let place = Place::Member(index, member);
            match meaning(place) {
                Some((ty, meaning)) => wrapper.value(module, meaning, ty),
                None => match items.iter().find(|item| item.place == place) {
                    Some(item) => wrapper.parameter(item.setting.clone().or(name), ty),
                    // What is not read.
                    None => wrapper.body.append(Expression::ZeroValue(ty)),
                },
            }
        });
        let components = parts.collect();
        handed.push(wrapper.body.emit(Expression::Compose { ty: argument.ty, components }));
    }
    for &(place, ty, meaning) in taken {
        let (Place::Variable(variable) | Place::VariableMember(variable, _)) = place else { continue };
        let value = wrapper.value(module, meaning, ty);
        let mut pointer = wrapper.body.append(Expression::GlobalVariable(variable));
        if let Place::VariableMember(_, index) = place {
            pointer = wrapper.body.emit(Expression::AccessIndex { base: pointer, index: index as u32 });
        }
        wrapper.body.block.push(Statement::Store { pointer, value }, Span::UNDEFINED);
        if matches!(place, Place::Variable(_)) {
            let variable = &mut module.global_variables[variable];
            (variable.space, variable.binding) = (AddressSpace::Private, None);
        }
    }
    let Wrapper { mut function, mut body, .. } = wrapper;
    body.return_call(target, handed);
    (function.expressions, function.body) = (body.expressions, body.block);
    function.result = function.result.map(|FunctionResult { ty, .. }| FunctionResult { ty, binding: None });
    let place = module.functions.get_span(target);
    module.functions.append(function, place)
}

/// A function that hands the values of a fragment to another one.
struct Wrapper {
    types: BTreeMap<&'static str, Handle<Type>>,
    function: Function,
    body: Body,
}

impl Wrapper {
    /// A parameter, of which there is one for each name.
    fn parameter(&mut self, name: Option<String>, ty: Handle<Type>) -> Handle<Expression> {
        let arguments = &mut self.function.arguments;
        let known = arguments.iter().position(|known| name.is_some() && known.name == name && known.ty == ty);
        let index = known.unwrap_or_else(|| {
            arguments.push(FunctionArgument { name, ty, binding: None });
            arguments.len() - 1
        });
        self.body.append(Expression::FunctionArgument(index as u32))
    }

    /// A value of a fragment, as a type that the file has for it.
    fn value(&mut self, module: &Module, meaning: &'static str, ty: Handle<Type>) -> Handle<Expression> {
        if meaning != PIXEL_SIZE {
            let from = self.types[meaning];
            let value = self.parameter(Some(meaning.to_owned()), from);
            return made(&mut self.body, module, meaning, value, from, ty);
        }
        let is_vector = matches!(module.types[ty].inner, TypeInner::Vector { .. });
        let fun = if is_vector { MathFunction::Abs } else { MathFunction::Length };
        let [a, b] = ["dpdx", "dpdy"].map(|name| {
            let arg = self.parameter(Some(name.to_owned()), self.types[name]);
            self.body.emit(Expression::Math { fun, arg, arg1: None, arg2: None, arg3: None })
        });
        let fun = MathFunction::Max;
        self.body.emit(Expression::Math { fun, arg: a, arg1: Some(b), arg2: None, arg3: None })
    }
}
