//! What a file calls the values of a fragment: the names that are usual, or those that the user gives (`--map position=pos`).

use super::body::Body;
use super::error::Fault;
use super::invalid::called_by;
use super::options::{ALPHA, Options};
use super::signature::{self, described, described_inner};
use super::variables::written_by;
use crate::shader::spelling::likely;
use core::fmt;
use naga::{
    AddressSpace, Expression, Function, FunctionArgument, FunctionResult, GlobalVariable, Handle,
    MathFunction, Module, ScalarKind, Span, Statement, StructMember, Type, TypeInner,
};
use std::collections::{BTreeMap, BTreeSet};

/// Names of other people for the values of a fragment, without case, underscores and the letters that tell where a value
/// comes from ([`plain`]).
const USUAL: [(&str, &[&str]); 10] = [
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
            "objcoord",
            "objectcoord",
            "local",
            "localpos",
            "localposition",
            "modelpos",
            "modelposition",
            "samplepos",
            "fragpos",
            "fragposition",
            "inputcoord",
            "hashinputcoord",
            "objposition",
            "positionobject",
            "positionworld",
            "positionlocal",
            "posobject",
            "posos",
            "posws",
            "posworld",
            "poslocal",
            "worldcoord",
            "worldspacepos",
            "worldspaceposition",
            "localspacepos",
            "localspaceposition",
            "localcoord",
            "objpos3d",
            "surfacepos",
            "surfaceposition",
            "vertexposition",
            "vertexpos",
            "hashpos",
            "hashposition",
            "hashcoord",
            "anchor",
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
    (
        "hash_scale",
        &[
            "hashscale",
            "alphahashscale",
            "noisescale",
            "noisesize",
            "noisepixels",
            "hashpixels",
            "hashsize",
            "grainsize",
        ],
    ),
    (
        PIXEL_SIZE,
        &[
            "pixelsize",
            "pixelwidth",
            "pixelfootprint",
            "maxderiv",
            "maxderivative",
            "maxd",
            "derivlength",
            "derivativelength",
            "derivlen",
            "ddmax",
            "maxdd",
            "pixderiv",
            "pixelderiv",
            "footprint",
            "texelsize",
        ],
    ),
];

/// The size of a pixel on the surface: the longer of the two derivatives, or of each axis the larger component.
const PIXEL_SIZE: &str = "pixel_size";

/// Words in the names of what alphas are compared with.
const OF_THRESHOLDS: [&str; 8] =
    ["thresh", "hash", "noise", "dither", "cutoff", "ref", "stochastic", "scale"];

/// Whether something sounds like the alpha of a fragment: by its name, or as the last component of a colour.
pub(super) fn is_alpha(written: &str) -> bool {
    let mut parts = written.trim_matches(|c: char| c == '(' || c == ')' || c.is_whitespace()).split('.');
    let name = plain(parts.next().unwrap_or_default());
    let is_path = !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_alphanumeric());
    let names_it = |name: &str| {
        ["alpha", "opacity", "coverage"].iter().any(|part| name.contains(part))
            && !OF_THRESHOLDS.iter().any(|part| name.contains(part))
    };
    let mut parts = parts.peekable();
    is_path
        && match parts.peek() {
            None => {
                names_it(&name)
                    || ["color", "colour", "albedo", "basecolor", "diffusecolor", "fragcolor"]
                        .contains(&name.as_str())
            }
            Some(_) => parts.last().is_some_and(|last| matches!(last, "a" | "w") || names_it(&plain(last))),
        }
}

/// What a file may have a name of its own for.
fn meanings() -> impl Iterator<Item = &'static str> {
    signature::values().chain([PIXEL_SIZE])
}

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

/// The value of a fragment that a name is known for.
pub(super) fn meaning_of(name: &str) -> Option<&'static str> {
    meanings().find(|&meaning| meaning == name || is_usual(meaning, name))
}

/// Whether a name says that it is a position, and none of a light, of the eye or on the screen.
fn sounds_like_position(name: &str) -> bool {
    const OTHERS: [&str; 12] = [
        "light", "cam", "eye", "view", "sun", "probe", "screen", "clip", "ndc", "shadow", "previous", "prev",
    ];
    let name = plain(name);
    let ends = ["position", "pos", "coord", "point", "positionos", "positionws", "posos", "posws"];
    ends.iter().any(|end| name.ends_with(end)) && !OTHERS.iter().any(|other| name.contains(other))
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
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    /// A parameter by its index.
    Parameter(usize),
    /// A member of one.
    Member(usize, usize),
    Variable(Handle<GlobalVariable>),
    VariableMember(Handle<GlobalVariable>, usize),
}

impl Place {
    const fn is_parameter(self) -> bool {
        matches!(self, Self::Parameter(_))
    }
}

struct Item {
    name: String,
    /// The setting that gives it a value.
    setting: Option<String>,
    /// With the name of the structure that it is a member of.
    full: String,
    ty: Handle<Type>,
    place: Place,
}

impl Item {
    fn is_called(&self, name: &str) -> bool {
        self.name == name || self.full == name
    }
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
    asked: &Options,
    settings: &BTreeMap<String, String>,
    inputs: &BTreeSet<String>,
    uniforms: &[String],
    pixels: &BTreeSet<String>,
) -> Result<Mapped, Fault> {
    let said = &asked.map;
    let items = items(module, target, settings);
    let mut taken: Vec<(&Item, &'static str)> = Vec::new();
    // The alpha of a test has been taken before.
    for (meaning, name) in said.iter().filter(|(meaning, _)| *meaning != ALPHA) {
        let Some(meaning) = meanings().find(|known| known == meaning) else {
            let known: Vec<_> = meanings().chain([ALPHA]).collect();
            let likely = likely(meaning, &known);
            let known = known.join(", ");
            return Err(Fault::new(format!(
                "--map {meaning}={name}: a fragment has no `{meaning}`.{likely} It has {known}"
            )));
        };
        let Some(item) = items.iter().find(|item| item.is_called(name) && item.setting.is_none()) else {
            let known: Vec<_> = items.iter().map(|item| item.name.as_str()).collect();
            let likely = likely(name, &known);
            let known = if known.is_empty() { "nothing".to_owned() } else { known.join(", ") };
            return Err(Fault::new(format!(
                "--map {meaning}={name}: no `{name}` waits for a value.{likely} What does is {known}"
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
    for meaning in meanings().filter(|&meaning| !said.contains_key(meaning)) {
        // A name of ours goes before all others, and is refused where its type is another.
        let is_ours = |item: &Item| item.name == meaning && !pixels.contains(&item.name);
        if items.iter().any(|item| {
            is_ours(item) && item.place.is_parameter() && !is_of_another_type(module, meaning, item.ty)
        }) {
            continue;
        }
        let is_free = |item: &&Item| {
            let is_another = meanings().any(|known| known == item.name) && item.name != meaning;
            item.setting.is_none()
                && (!is_another || pixels.contains(&item.name))
                && !said.values().any(|name| item.is_called(name))
        };
        let is_meant = |item: &Item| {
            // In blocks are the positions of lights and of the eye.
            let is_of_block = matches!(item.place, Place::VariableMember(variable, _)
                if module.global_variables[variable].space != AddressSpace::Private
                    || module.global_variables[variable].name.as_ref().is_some_and(|name| uniforms.contains(name)));
            if pixels.contains(&item.name) {
                meaning == "pixel"
            } else {
                is_usual(meaning, &item.name) && (!is_of_block || matches!(meaning, "frame" | "hash_scale"))
            }
        };
        let fits = |item: &&Item| is_meant(item) && is_made(module, meaning, item.ty);
        let found = || items.iter().filter(is_free).filter(fits);
        let parameters = found().filter(|item| matches!(item.place, Place::Parameter(_) | Place::Member(..)));
        let exact = found().filter(|item| is_ours(item));
        if let Some(item) = only(exact).or_else(|| only(parameters)).or_else(|| only(found())) {
            taken.push((item, meaning));
        }
    }
    // Where nothing has a usual name: one that sounds like a position, then the only vector that comes from the fragment.
    let has_position = taken.iter().any(|(_, meaning)| *meaning == "position")
        || items.iter().any(|item| item.name == "position" && item.place.is_parameter());
    if !has_position {
        let is_vector = |item: &&Item| {
            let is_free = item.setting.is_none()
                && !pixels.contains(&item.name)
                && !taken.iter().any(|(taken, _)| taken.place == item.place);
            let is_of_fragment = match item.place {
                Place::Parameter(_) | Place::Member(..) => true,
                Place::Variable(_) => inputs.contains(&item.name),
                Place::VariableMember(handle, _) => {
                    module.global_variables[handle].name.as_ref().is_some_and(|name| inputs.contains(name))
                }
            };
            let is_another = meanings().any(|known| known == item.name || is_usual(known, &item.name));
            shape(&module.types[item.ty].inner) == Some((3, ScalarKind::Float))
                && is_free
                && is_of_fragment
                && !is_another
        };
        let sounds = |item: &&Item| sounds_like_position(&item.name);
        let item = only(items.iter().filter(is_vector).filter(sounds))
            .or_else(|| only(items.iter().filter(is_vector)));
        taken.extend(item.map(|item| (item, "position")));
    }
    let mut notes: Vec<_> =
        taken.iter().map(|(item, meaning)| Taken { name: item.name.clone(), meaning }).collect();
    let names = notes.iter().map(|taken| taken.name.clone()).collect();
    notes.retain(|taken| taken.name != taken.meaning);
    let has_structures =
        module.functions[target].arguments.iter().any(|argument| members(module, argument.ty).is_some());
    let taken: Vec<_> = taken.into_iter().map(|(item, meaning)| (item.place, item.ty, meaning)).collect();
    refuse_unset(module, &items, &taken, uniforms)?;
    let mut members = BTreeMap::<_, BTreeSet<_>>::new();
    for &(place, ..) in &taken {
        if let Place::VariableMember(variable, member) = place {
            members.entry(variable).or_default().insert(member);
        }
    }
    let target =
        if taken.is_empty() && !has_structures { target } else { wrap(module, target, &taken, &items) };
    Ok(Mapped { target, notes, names, members })
}

/// A function that takes the values of a fragment.
pub(super) struct Mapped {
    pub target: Handle<Function>,
    /// What was taken for what under another name.
    pub notes: Vec<Taken>,
    /// The names of all that has got a value.
    pub names: BTreeSet<String>,
    /// The members of variables that have got a value.
    pub members: BTreeMap<Handle<GlobalVariable>, BTreeSet<usize>>,
}

/// Refuses members of inputs that are read and stand for nothing, beside others that do.
fn refuse_unset(
    module: &Module,
    items: &[Item],
    taken: &[(Place, Handle<Type>, &str)],
    uniforms: &[String],
) -> Result<(), Fault> {
    for item in items {
        let Place::VariableMember(variable, _) = item.place else { continue };
        // What is not set of a uniform is refused with its block.
        if module.global_variables[variable].name.as_ref().is_some_and(|name| uniforms.contains(name)) {
            continue;
        }
        let is_taken = |place: Place| taken.iter().any(|(taken, ..)| *taken == place);
        if module.global_variables[variable].space == AddressSpace::Private && !is_taken(item.place) {
            let Item { full, name, .. } = item;
            let message = format!(
                "`{full}` has no value: what comes from the rest of a program is a value of the fragment (--map position={name}), \
                 or a parameter"
            );
            return Err(Fault::new(message).at(module.global_variables.get_span(variable).to_range()));
        }
    }
    Ok(())
}

/// The members of a structure.
fn members(module: &Module, ty: Handle<Type>) -> Option<&[StructMember]> {
    match &module.types[ty].inner {
        TypeInner::Struct { members, .. } => Some(members),
        _ => None,
    }
}

/// What waits for a value: parameters, members of those that are structures, and variables that the function comes to and nothing
/// has filled.
fn items(module: &Module, target: Handle<Function>, settings: &BTreeMap<String, String>) -> Vec<Item> {
    let mut found = Vec::new();
    let function = &module.functions[target];
    for (index, argument) in function.arguments.iter().enumerate() {
        let name = argument.name.clone().unwrap_or_default();
        let Some(members) = members(module, argument.ty) else {
            found.push(Item {
                full: name.clone(),
                name,
                setting: None,
                ty: argument.ty,
                place: Place::Parameter(index),
            });
            continue;
        };
        let reads = reads(module, target, Expression::FunctionArgument(index as u32), 0);
        found.extend(of_members(&name, members, reads.as_ref(), |member| Place::Member(index, member)));
    }
    let functions = reached_from(module, target);
    let written: BTreeSet<_> =
        functions.iter().flat_map(|&function| written_by(&module.functions[function])).collect();
    for handle in read_by(module, &functions).into_iter().filter(|handle| !written.contains(handle)) {
        let variable = &module.global_variables[handle];
        let is_plain =
            matches!(variable.space, AddressSpace::Private | AddressSpace::Uniform | AddressSpace::Immediate);
        if !is_plain || variable.init.is_some() {
            continue;
        }
        // A compiler of HLSL gives a block an empty name.
        let name = variable
            .name
            .clone()
            .filter(|name| !name.is_empty())
            .or_else(|| module.types[variable.ty].name.clone());
        let name = name.unwrap_or_default();
        match members(module, variable.ty) {
            None => found.push(Item {
                full: name.clone(),
                name,
                setting: None,
                ty: variable.ty,
                place: Place::Variable(handle),
            }),
            Some(members) => {
                let all = functions.iter().map(|&f| reads(module, f, Expression::GlobalVariable(handle), 0));
                let reads: Option<BTreeSet<usize>> =
                    all.collect::<Option<Vec<_>>>().map(|all| all.into_iter().flatten().collect());
                found.extend(of_members(&name, members, reads.as_ref(), |member| {
                    Place::VariableMember(handle, member)
                }));
            }
        }
    }
    found.retain(|item| !item.name.is_empty());
    for item in &mut found {
        item.setting = settings.keys().find(|name| item.is_called(name)).cloned();
    }
    // Only members of parameters are still needed where they are set.
    found.retain(|item| item.setting.is_none() || matches!(item.place, Place::Member(..)));
    found
}

/// The members of a structure that are read, all where that is not known.
fn of_members(
    of: &str,
    members: &[StructMember],
    reads: Option<&BTreeSet<usize>>,
    place: impl Fn(usize) -> Place,
) -> Vec<Item> {
    let read =
        members.iter().enumerate().filter(|(index, _)| reads.is_none_or(|reads| reads.contains(index)));
    read.map(|(index, member)| {
        let name = member.name.clone().unwrap_or_default();
        Item { full: format!("{of}.{name}"), name, setting: None, ty: member.ty, place: place(index) }
    })
    .collect()
}

/// Which members of a structure a function reads, by itself or in those that it hands it to; nothing where it goes somewhere as a
/// whole.
fn reads(
    module: &Module,
    function: Handle<Function>,
    what: Expression,
    depth: usize,
) -> Option<BTreeSet<usize>> {
    const DEEPEST: usize = 16;
    if depth > DEEPEST {
        return None;
    }
    let body = &module.functions[function];
    let is_it = |expression: &Expression| match (expression, &what) {
        (Expression::FunctionArgument(a), Expression::FunctionArgument(b)) => a == b,
        (Expression::GlobalVariable(a), Expression::GlobalVariable(b)) => a == b,
        _ => false,
    };
    let mut same: BTreeSet<_> = body.expressions.iter().filter(|(_, e)| is_it(e)).map(|(at, _)| at).collect();
    let statements = all_statements(&body.body);
    // A copy in a variable, and what is read of it.
    loop {
        let before = same.len();
        for statement in &statements {
            if let Statement::Store { pointer, value } = **statement
                && same.contains(&value)
            {
                match body.expressions[pointer] {
                    Expression::LocalVariable(_) => drop(same.insert(pointer)),
                    _ => return None,
                }
            }
        }
        let loads = body
            .expressions
            .iter()
            .filter(|(_, e)| matches!(e, Expression::Load { pointer } if same.contains(pointer)));
        let loads: Vec<_> = loads.map(|(at, _)| at).collect();
        same.extend(loads);
        if same.len() == before {
            break;
        }
    }
    let mut found = BTreeSet::new();
    let given = given(body, &same);
    // The front end of GLSL leads to every member of a block, and reads some.
    let is_pointer = |at: Handle<Expression>| match body.expressions[at] {
        Expression::GlobalVariable(_) | Expression::LocalVariable(_) => true,
        Expression::FunctionArgument(index) => {
            matches!(module.types[body.arguments[index as usize].ty].inner, TypeInner::Pointer { .. })
        }
        _ => false,
    };
    let handed: BTreeSet<_> = statements
        .iter()
        .filter_map(|statement| match statement {
            Statement::Call { arguments, .. } => Some(arguments),
            _ => None,
        })
        .flatten()
        .copied()
        .collect();
    let is_used = |at: Handle<Expression>| {
        handed.contains(&at)
            || body.expressions.iter().any(|(_, expression)| match *expression {
                Expression::Load { pointer } => pointer == at,
                Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => base == at,
                _ => false,
            })
    };
    for (at, expression) in body.expressions.iter() {
        match expression {
            // What the function itself gives a value to waits for none.
            Expression::AccessIndex { base, index }
                if same.contains(base) && !given.contains(index) && (!is_pointer(*base) || is_used(at)) =>
            {
                found.insert(*index as usize);
            }
            Expression::Compose { components, .. } if components.iter().any(|part| same.contains(part)) => {
                return None;
            }
            _ => {}
        }
    }
    for statement in statements {
        match statement {
            Statement::Call { function: called, arguments, .. } => {
                for (index, _) in arguments.iter().enumerate().filter(|(_, argument)| same.contains(argument))
                {
                    found.extend(reads(
                        module,
                        *called,
                        Expression::FunctionArgument(index as u32),
                        depth + 1,
                    )?);
                }
            }
            Statement::Return { value: Some(value) } if same.contains(value) => return None,
            _ => {}
        }
    }
    Some(found)
}

/// The members of a structure, by what stands for it, that a function gives a value to before it reads them, whatever the way.
fn given(body: &Function, same: &BTreeSet<Handle<Expression>>) -> BTreeSet<u32> {
    let member = |at: Handle<Expression>| match body.expressions[at] {
        Expression::AccessIndex { base, index } if same.contains(&base) => Some(index),
        _ => None,
    };
    let is_load = |at: Handle<Expression>| matches!(body.expressions[at], Expression::Load { .. });
    // What an emitted expression reads.
    let read = |at: Handle<Expression>| match body.expressions[at] {
        Expression::Load { pointer } => member(pointer),
        Expression::AccessIndex { base, .. } if is_load(base) => member(at),
        _ => None,
    };
    let (mut given, mut was_read) = (BTreeSet::new(), BTreeSet::new());
    for statement in body.body.iter() {
        let block = naga::Block::from_vec(vec![statement.clone()]);
        for within in all_statements(&block) {
            if let Statement::Emit(range) = within {
                was_read.extend(range.clone().filter_map(read).filter(|index| !given.contains(index)));
            }
        }
        // Within a branch it may not be given.
        if let Statement::Store { pointer, .. } = statement {
            given.extend(member(*pointer).filter(|index| !was_read.contains(index)));
        }
    }
    given
}

/// The statements of a block and of those in it.
fn all_statements(block: &naga::Block) -> Vec<&Statement> {
    let mut found = Vec::new();
    let mut blocks = vec![block];
    while let Some(block) = blocks.pop() {
        for statement in block.iter() {
            found.push(statement);
            match statement {
                Statement::Block(inner) => blocks.push(inner),
                Statement::If { accept, reject, .. } => blocks.extend([accept, reject]),
                Statement::Switch { cases, .. } => blocks.extend(cases.iter().map(|case| &case.body)),
                Statement::Loop { body, continuing, .. } => blocks.extend([body, continuing]),
                _ => {}
            }
        }
    }
    found
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

/// Whether a type is not that of a value of a fragment, and can be made out of it.
fn is_of_another_type(module: &Module, meaning: &str, ty: Handle<Type>) -> bool {
    let is_same = shape(&module.types[ty].inner) == shape(&signature::type_of(meaning).inner);
    meaning == PIXEL_SIZE || !is_same && is_made(module, meaning, ty)
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

fn wrap(
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
