//! Uniform blocks: structures whose members get their values one by one.

use super::error::Fault;
use super::invalid::find;
use super::setting::Constant;
use super::signature::described;
use naga::{
    AddressSpace, Expression, Function, GlobalVariable, Handle, Module, Span, Statement, StructMember, Type,
    TypeInner,
};
use std::collections::{BTreeMap, BTreeSet};

/// The way to a member of a structure, from the outermost.
type Way = Vec<usize>;

/// The members of uniform structures that have a value, by the name of the structure.
pub(super) type Filled = BTreeMap<String, BTreeSet<Way>>;

/// Makes uniform structures private variables that begin with the values that `settings` has for their members, by
/// `block.member` or by `member`, and `block.member.part` where that is a structure again; the others are zero. Returns which members of
/// which block have a value, those that are `taken` for a value of the fragment among them.
///
/// # Errors
///
/// A value of another type.
pub(super) fn fill(
    module: &mut Module,
    settings: &mut BTreeMap<String, String>,
    uniforms: &[String],
    taken: &BTreeMap<Handle<GlobalVariable>, BTreeSet<usize>>,
) -> Result<Filled, Fault> {
    let mut blocks = Filled::new();
    let handles: Vec<_> = module.global_variables.iter().map(|(handle, _)| handle).collect();
    for handle in handles {
        let variable = &module.global_variables[handle];
        let Some((name, _)) = block(module, variable, uniforms) else { continue };
        let ty = variable.ty;
        let at = module.global_variables.get_span(handle).to_range();
        let mut filled: BTreeSet<Way> =
            taken.get(&handle).into_iter().flatten().map(|&member| vec![member]).collect();
        let mut names = vec![name.clone()];
        let init = value(module, ty, &mut names, &mut Way::new(), settings, &mut filled)
            .map_err(|error| Fault::new(error).at(at))?;
        let variable = &mut module.global_variables[handle];
        (variable.space, variable.binding, variable.init) = (AddressSpace::Private, None, Some(init));
        blocks.insert(name, filled);
    }
    Ok(blocks)
}

/// The value of a member, or of a structure of them: what `settings` has for the names on the way to it, or zero.
fn value(
    module: &mut Module,
    ty: Handle<Type>,
    names: &mut Vec<String>,
    way: &mut Way,
    settings: &mut BTreeMap<String, String>,
    filled: &mut BTreeSet<Way>,
) -> Result<Handle<Expression>, String> {
    if let TypeInner::Struct { members, .. } = module.types[ty].inner.clone() {
        let mut components = Vec::new();
        for (index, member) in members.into_iter().enumerate() {
            names.push(member.name.unwrap_or_default());
            way.push(index);
            components.push(value(module, member.ty, names, way, settings, filled)?);
            names.pop();
            way.pop();
        }
        return Ok(module.global_expressions.append(Expression::Compose { ty, components }, Span::UNDEFINED));
    }
    // The whole name first, then without the block, and so on.
    let written = (0..names.len()).find_map(|from| settings.remove(&names[from..].join(".")));
    let Some(written) = written else {
        return Ok(module.global_expressions.append(Expression::ZeroValue(ty), Span::UNDEFINED));
    };
    let own = names.last().map_or("", String::as_str);
    let constant = Constant::parse(own, &module.types[ty].inner, &written)?;
    filled.insert(way.clone());
    Ok(constant.append(ty, module))
}

/// Refuses what reads a member without a value, or a structure as a whole that has such a member.
pub(super) fn refuse_unset(module: &Module, blocks: &Filled) -> Result<(), Fault> {
    for (_, function) in module.functions.iter() {
        for (place, expression) in function.expressions.iter() {
            let Expression::GlobalVariable(handle) = *expression else { continue };
            let variable = &module.global_variables[handle];
            let Some((name, _)) = structure(module, variable) else { continue };
            let Some(filled) = blocks.get(&name) else { continue };
            for (way, read) in read(function, place) {
                let Some((names, ty)) = unset(module, variable.ty, &way, &mut Way::new(), filled) else {
                    continue;
                };
                let key = names.last().cloned().unwrap_or_default();
                // The block of HLSL in which uniforms outside of all blocks are.
                let outer = if name.starts_with('$') { None } else { Some(&name) };
                let typed = outer.into_iter().chain(&names).cloned().collect::<Vec<_>>().join(".");
                let message = match Constant::form(&module.types[ty].inner) {
                    Some(form) => {
                        format!("`{key}` of uniform block `{name}` has no value: --set {typed}={form}")
                    }
                    None => format!(
                        "`{key}` of uniform block `{name}`, of type {}, has no value, and --set gives one to numbers and vectors \
                         only: make what is read of it a parameter",
                        described(module, ty)
                    ),
                };
                let at = function.expressions.get_span(read).to_range();
                let at = at.or_else(|| module.global_variables.get_span(handle).to_range());
                return Err(Fault::new(message).at(at));
            }
        }
    }
    Ok(())
}

/// The first member on a way, or within what it leads to, that has no value: the names to it, and its type.
fn unset(
    module: &Module,
    ty: Handle<Type>,
    asked: &[usize],
    way: &mut Way,
    filled: &BTreeSet<Way>,
) -> Option<(Vec<String>, Handle<Type>)> {
    if filled.contains(way) {
        return None;
    }
    let TypeInner::Struct { members, .. } = &module.types[ty].inner else { return Some((Vec::new(), ty)) };
    let (first, rest) = asked.split_first().map_or((None, asked), |(first, rest)| (Some(*first), rest));
    let wanted = members.iter().enumerate().filter(|(index, _)| first.is_none_or(|first| first == *index));
    for (index, member) in wanted {
        way.push(index);
        let found = unset(module, member.ty, rest, way, filled);
        way.pop();
        if let Some((mut names, ty)) = found {
            names.insert(0, member.name.clone().unwrap_or_default());
            return Some((names, ty));
        }
    }
    None
}

/// The ways on which a function reads a variable, to its end where it is a structure that goes somewhere as a whole, and by which expression.
fn read(function: &Function, variable: Handle<Expression>) -> Vec<(Way, Handle<Expression>)> {
    // What stands for the variable or for a part of it, by the way to it.
    let mut ways = BTreeMap::from([(variable, Way::new())]);
    let mut found = Vec::new();
    for (at, expression) in function.expressions.iter() {
        match *expression {
            Expression::AccessIndex { base, index } => {
                if let Some(way) = ways.get(&base) {
                    ways.insert(at, [&way[..], &[index as usize]].concat());
                }
            }
            Expression::Load { pointer } => {
                if let Some(way) = ways.get(&pointer).cloned() {
                    ways.insert(at, way);
                }
            }
            _ => {}
        }
    }
    let leads_on = |at| {
        function.expressions.iter().any(|(_, expression)| match *expression {
            Expression::AccessIndex { base, .. } => base == at,
            Expression::Load { pointer } => pointer == at,
            _ => false,
        })
    };
    for (&at, way) in &ways {
        let is_load = matches!(function.expressions[at], Expression::Load { .. });
        if !leads_on(at) && at != variable || is_load && is_handed_on(function, at) {
            found.push((way.clone(), at));
        }
    }
    found
}

/// Whether a structure goes somewhere as a whole.
fn is_handed_on(function: &Function, structure: Handle<Expression>) -> bool {
    let is_part = |expression: &Expression| match expression {
        Expression::Compose { components, .. } => components.contains(&structure),
        _ => false,
    };
    let takes_it = |statement: &Statement| match statement {
        Statement::Store { value, .. } => *value == structure,
        Statement::Return { value } => *value == Some(structure),
        Statement::Call { arguments, .. } => arguments.contains(&structure),
        _ => false,
    };
    function.expressions.iter().any(|(_, expression)| is_part(expression))
        || find(&function.body, &takes_it).is_some()
}

/// The name of a uniform block, of push constants or of a uniform structure, that of its type where the variable has none, and its members.
fn block<'m>(
    module: &'m Module,
    variable: &GlobalVariable,
    uniforms: &[String],
) -> Option<(String, &'m [StructMember])> {
    let is_named = variable.name.as_ref().is_some_and(|name| uniforms.contains(name));
    let is_uniform = is_named || matches!(variable.space, AddressSpace::Uniform | AddressSpace::Immediate);
    structure(module, variable).filter(|_| is_uniform)
}

fn structure<'m>(module: &'m Module, variable: &GlobalVariable) -> Option<(String, &'m [StructMember])> {
    let ty = &module.types[variable.ty];
    let TypeInner::Struct { members, .. } = &ty.inner else { return None };
    // A compiler of HLSL gives the variable an empty name.
    let name = variable.name.clone().filter(|name| !name.is_empty());
    Some((name.or_else(|| ty.name.clone())?, members))
}
