//! What of a function waits for a value: parameters, members of structures, and variables that nothing has filled.

use super::invalid::called_by;
use super::variables::written_by;
use naga::{
    AddressSpace, Expression, Function, GlobalVariable, Handle, Module, Statement, StructMember, Type,
    TypeInner,
};
use std::collections::{BTreeMap, BTreeSet};

/// Something that waits for a value.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// A parameter by its index.
    Parameter(usize),
    /// A member of one.
    Member(usize, usize),
    Variable(Handle<GlobalVariable>),
    VariableMember(Handle<GlobalVariable>, usize),
}

impl Place {
    pub const fn is_parameter(self) -> bool {
        matches!(self, Self::Parameter(_))
    }
}

pub(super) struct Item {
    pub name: String,
    /// The setting that gives it a value.
    pub setting: Option<String>,
    /// With the name of the structure that it is a member of.
    pub full: String,
    pub ty: Handle<Type>,
    pub place: Place,
}

impl Item {
    pub fn is_called(&self, name: &str) -> bool {
        self.name == name || self.full == name
    }
}

/// The members of a structure.
pub(super) fn members(module: &Module, ty: Handle<Type>) -> Option<&[StructMember]> {
    match &module.types[ty].inner {
        TypeInner::Struct { members, .. } => Some(members),
        _ => None,
    }
}

/// What waits for a value: parameters, members of those that are structures, and variables that the function comes to and nothing
/// has filled.
pub(super) fn items(
    module: &Module,
    target: Handle<Function>,
    settings: &BTreeMap<String, String>,
) -> Vec<Item> {
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
