//! What a file calls the values of a fragment: the names that are usual, or those that the user gives (`--map position=pos`).

use super::body::Body;
use super::error::Fault;
use super::invalid::called_by;
use super::options::Options;
use super::signature::{self, described, described_inner};
use super::variables::written_by;
use core::fmt;
use naga::{
    AddressSpace, Expression, Function, FunctionArgument, FunctionResult, GlobalVariable, Handle, Module,
    ScalarKind, Span, Statement, Type, TypeInner,
};
use std::collections::{BTreeMap, BTreeSet};

/// Names of other people for the values of a fragment, without case, underscores and the letters that tell where a value
/// comes from ([`plain`]).
const USUAL: [(&str, &[&str]); 9] = [
    (
        "position",
        &[
            "position",
            "positionos",
            "positionws",
            "positionls",
            "pos",
            "p",
            "co",
            "wp",
            "wpos",
            "opos",
            "worldpos",
            "worldposition",
            "objectpos",
            "objectposition",
            "objectspacepos",
            "objectspaceposition",
            "objpos",
            "objposition",
            "objcoord",
            "objectcoord",
            "localpos",
            "localposition",
            "modelpos",
            "modelposition",
            "samplepos",
            "fragpos",
            "fragposition",
            "inputcoord",
            "hashinputcoord",
            "point",
            "coord",
            "coords",
        ],
    ),
    (
        "dpdx",
        &["dpdx", "ddx", "dx", "dposdx", "dpositiondx", "posdx", "positiondx", "posddx", "ddxpos", "dxpos"],
    ),
    (
        "dpdy",
        &["dpdy", "ddy", "dy", "dposdy", "dpositiondy", "posdy", "positiondy", "posddy", "ddypos", "dypos"],
    ),
    (
        "pixel",
        &[
            "pixel",
            "pixelpos",
            "pixelcoord",
            "fragcoord",
            "glfragcoord",
            "svposition",
            "screenpos",
            "screencoord",
            "pix",
        ],
    ),
    ("texcoord", &["texcoord", "texcoords", "texcoord0", "uv", "uvs", "uv0"]),
    ("lod", &["lod", "mip", "miplevel"]),
    ("frame", &["frame", "frameindex", "framecount", "framenumber", "frameid", "iframe"]),
    ("layer", &["layer", "layerindex"]),
    ("hash_scale", &["hashscale", "alphahashscale"]),
];

/// A name without case and underscores, without `v_`, `u_` and their kin in front, and without the number that Slang puts behind.
fn plain(name: &str) -> String {
    let name = name
        .rsplit_once('_')
        .filter(|(_, end)| end.bytes().all(|b| b.is_ascii_digit()))
        .map_or(name, |(n, _)| n);
    let without = ["v_", "u_", "i_", "a_", "g_", "in_", "fs_", "_"]
        .into_iter()
        .find_map(|mark| name.strip_prefix(mark));
    let name = without.unwrap_or(name);
    // vPos, uFrame, gHashScale.
    let mut letters = name.chars();
    let is_marked = matches!(letters.next(), Some('v' | 'u' | 'i' | 'a' | 'g'))
        && letters.next().is_some_and(char::is_uppercase);
    let name = if is_marked { &name[1..] } else { name };
    name.chars().filter(|&letter| letter != '_').flat_map(char::to_lowercase).collect()
}

/// Whether a name is one of those under which a value of a fragment is known.
fn is_usual(of: &str, name: &str) -> bool {
    let name = plain(name);
    USUAL.iter().any(|(known, names)| *known == of && names.contains(&name.as_str()))
}

/// Finds the position among the vectors of three that a text declares, by the rules of [`map`]; before it is parsed.
pub(super) fn position_among<'n>(names: &[&'n str], asked: &Options) -> Option<&'n str> {
    let free = || names.iter().copied().filter(|&name| !asked.settings.contains_key(name));
    if let Some(said) = asked.map.get("position") {
        return free().find(|name| name == said);
    }
    free().find(|&name| name == "position").or_else(|| only(free().filter(|name| is_usual("position", name))))
}

fn only<T>(mut found: impl Iterator<Item = T>) -> Option<T> {
    found.next().filter(|_| found.next().is_none())
}

/// A value of a fragment under the name that the file has for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Taken {
    /// The name in the file.
    pub name: String,
    /// What it is taken for: a parameter of [`super::Input`], as `position`.
    pub meaning: &'static str,
}

impl fmt::Display for Taken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, meaning } = self;
        write!(f, "`{name}` is taken for `{meaning}`")
    }
}

/// Something that waits for a value.
#[derive(Clone, Copy)]
enum Place {
    /// A parameter by its index.
    Parameter(usize),
    Variable(Handle<GlobalVariable>),
}

struct Item {
    name: String,
    ty: Handle<Type>,
    place: Place,
}

/// Wraps `target` in a function whose parameters have the names and types of a fragment's values, for all that the user says
/// or whose name is usual; what has a value by `settings` keeps it. Returns `target` where nothing has another name.
///
/// # Errors
///
/// A name of the user's that is not there, or is no value of a fragment; a type that nothing can be made into.
pub(super) fn map(
    module: &mut Module,
    target: Handle<Function>,
    said: &BTreeMap<String, String>,
    settings: &BTreeMap<String, String>,
) -> Result<(Handle<Function>, Vec<Taken>), Fault> {
    let items = items(module, target, settings);
    let mut taken: Vec<(&Item, &'static str)> = Vec::new();
    for (meaning, name) in said {
        let Some(meaning) = signature::values().find(|known| known == meaning) else {
            let known: Vec<_> = signature::values().collect();
            return Err(Fault::new(format!("--map {meaning}={name}: a fragment has {}", known.join(", "))));
        };
        let Some(item) = items.iter().find(|item| item.name == *name) else {
            let known: Vec<_> = items.iter().map(|item| item.name.as_str()).collect();
            let known = if known.is_empty() { "nothing".to_owned() } else { known.join(", ") };
            return Err(Fault::new(format!(
                "--map {meaning}={name}: no `{name}` waits for a value; what does is {known}"
            )));
        };
        if !is_made(module, meaning, item.ty) {
            let ours = described_inner(module, &signature::type_of(meaning).inner);
            let found = described(module, item.ty);
            return Err(Fault::new(format!(
                "--map {meaning}={name}: `{name}` is {found}, which nothing makes out of {ours}"
            )));
        }
        taken.push((item, meaning));
    }
    for meaning in signature::values().filter(|&meaning| !said.contains_key(meaning)) {
        // A name of ours goes before all others, and is refused where its type is another.
        if items.iter().any(|item| item.name == meaning && matches!(item.place, Place::Parameter(_))) {
            continue;
        }
        let is_free = |item: &&Item| {
            let is_ours = signature::values().any(|known| known == item.name) && item.name != meaning;
            !is_ours && !said.values().any(|name| *name == item.name)
        };
        let fits = |item: &&Item| is_usual(meaning, &item.name) && is_made(module, meaning, item.ty);
        let found = || items.iter().filter(is_free).filter(fits);
        let parameters = found().filter(|item| matches!(item.place, Place::Parameter(_)));
        if let Some(item) = only(parameters).or_else(|| only(found())) {
            taken.push((item, meaning));
        }
    }
    let mut notes: Vec<_> =
        taken.iter().map(|(item, meaning)| Taken { name: item.name.clone(), meaning }).collect();
    notes.retain(|taken| taken.name != taken.meaning);
    let taken: Vec<_> = taken.into_iter().map(|(item, meaning)| (item.place, item.ty, meaning)).collect();
    let wrapped = if taken.is_empty() { target } else { wrap(module, target, &taken) };
    Ok((wrapped, notes))
}

/// What waits for a value: parameters, and variables that the function comes to and nothing has filled.
fn items(module: &Module, target: Handle<Function>, settings: &BTreeMap<String, String>) -> Vec<Item> {
    let parameters = module.functions[target].arguments.iter().enumerate();
    let parameters = parameters.filter_map(|(index, argument)| {
        Some(Item { name: argument.name.clone()?, ty: argument.ty, place: Place::Parameter(index) })
    });
    let functions = reached_from(module, target);
    let written: BTreeSet<_> =
        functions.iter().flat_map(|&function| written_by(&module.functions[function])).collect();
    let variables = read_by(module, &functions).into_iter().filter(|handle| !written.contains(handle));
    let variables = variables.filter_map(|handle| {
        let variable = &module.global_variables[handle];
        let is_plain = matches!(variable.space, AddressSpace::Private | AddressSpace::Uniform);
        let name = variable.name.clone().filter(|_| is_plain && variable.init.is_none())?;
        Some(Item { name, ty: variable.ty, place: Place::Variable(handle) })
    });
    parameters.chain(variables).filter(|item| !settings.contains_key(&item.name)).collect()
}

/// A function and all that it calls.
pub(super) fn reached_from(module: &Module, target: Handle<Function>) -> BTreeSet<Handle<Function>> {
    let (mut open, mut reached) = (vec![target], BTreeSet::new());
    while let Some(function) = open.pop() {
        if reached.insert(function) {
            open.extend(called_by(&module.functions[function].body));
        }
    }
    reached
}

/// The variables that functions name.
fn read_by(module: &Module, functions: &BTreeSet<Handle<Function>>) -> BTreeSet<Handle<GlobalVariable>> {
    let expressions = functions.iter().flat_map(|&function| module.functions[function].expressions.iter());
    let named = expressions.filter_map(|(_, expression)| match *expression {
        Expression::GlobalVariable(variable) => Some(variable),
        _ => None,
    });
    named.collect()
}

/// The number of components and the kind of a type of 32 bits.
fn shape(inner: &TypeInner) -> Option<(usize, ScalarKind)> {
    let (size, scalar) = match *inner {
        TypeInner::Scalar(scalar) => (1, scalar),
        TypeInner::Vector { size, scalar } => (size as usize, scalar),
        _ => return None,
    };
    (scalar.width == 4).then_some((size, scalar.kind))
}

/// Whether [`made`] can make a type out of a value of a fragment.
fn is_made(module: &Module, meaning: &str, ty: Handle<Type>) -> bool {
    let Some((size, kind)) = shape(&module.types[ty].inner) else { return false };
    match meaning {
        "position" => matches!(size, 3 | 4) && kind == ScalarKind::Float,
        "dpdx" | "dpdy" => size == 3 && kind == ScalarKind::Float,
        "pixel" => size >= 2 && kind == ScalarKind::Float || size == 2,
        "texcoord" => size == 2 && kind == ScalarKind::Float,
        "frame" | "layer" => size == 1,
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

fn wrap(
    module: &mut Module,
    target: Handle<Function>,
    taken: &[(Place, Handle<Type>, &'static str)],
) -> Handle<Function> {
    let mut function = Function { result: module.functions[target].result.clone(), ..Function::default() };
    let mut body = Body::default();
    let mut parameter = |body: &mut Body, name: Option<String>, ty| {
        let known = function
            .arguments
            .iter()
            .position(|known| name.is_some() && known.name == name && known.ty == ty);
        let index = known.unwrap_or_else(|| {
            function.arguments.push(FunctionArgument { name, ty, binding: None });
            function.arguments.len() - 1
        });
        body.append(Expression::FunctionArgument(index as u32))
    };
    let types: BTreeMap<&str, Handle<Type>> = taken
        .iter()
        .map(|&(_, _, meaning)| (meaning, module.types.insert(signature::type_of(meaning), Span::UNDEFINED)))
        .collect();
    let mut handed = Vec::new();
    for (index, argument) in module.functions[target].arguments.clone().into_iter().enumerate() {
        let mapped = taken.iter().find(|(place, ..)| matches!(place, Place::Parameter(at) if *at == index));
        handed.push(match mapped {
            Some(&(_, ty, meaning)) => {
                let from = types[meaning];
                let value = parameter(&mut body, Some(meaning.to_owned()), from);
                made(&mut body, module, meaning, value, from, ty)
            }
            None => parameter(&mut body, argument.name, argument.ty),
        });
    }
    for &(place, ty, meaning) in taken {
        if let Place::Variable(variable) = place {
            let from = types[meaning];
            let value = parameter(&mut body, Some(meaning.to_owned()), from);
            let value = made(&mut body, module, meaning, value, from, ty);
            let pointer = body.append(Expression::GlobalVariable(variable));
            body.block.push(Statement::Store { pointer, value }, Span::UNDEFINED);
            let variable = &mut module.global_variables[variable];
            (variable.space, variable.binding) = (AddressSpace::Private, None);
        }
    }
    body.return_call(target, handed);
    (function.expressions, function.body) = (body.expressions, body.block);
    function.result = function.result.map(|FunctionResult { ty, .. }| FunctionResult { ty, binding: None });
    let place = module.functions.get_span(target);
    module.functions.append(function, place)
}
