//! Uniform blocks: structures whose members get their values one by one.

use super::error::Fault;
use super::invalid::find;
use super::setting::Constant;
use super::signature::described;
use naga::{
    AddressSpace, Expression, Function, GlobalVariable, Handle, Module, Span, Statement, StructMember,
    TypeInner,
};
use std::collections::{BTreeMap, BTreeSet};

/// Makes uniform structures private variables that begin with the values that `settings` has for their members, by
/// `block.member` or by `member`; the others are zero. Returns which members of which block have a value, those that are `taken` for a
/// value of the fragment among them.
///
/// # Errors
///
/// A value of another type.
pub(super) fn fill(
    module: &mut Module,
    settings: &mut BTreeMap<String, String>,
    uniforms: &[String],
    taken: &BTreeMap<Handle<GlobalVariable>, BTreeSet<usize>>,
) -> Result<BTreeMap<String, Vec<bool>>, Fault> {
    let mut blocks = BTreeMap::new();
    let handles: Vec<_> = module.global_variables.iter().map(|(handle, _)| handle).collect();
    for handle in handles {
        let variable = &module.global_variables[handle];
        let Some((name, members)) = block(module, variable, uniforms) else { continue };
        let (ty, members) = (variable.ty, members.to_vec());
        let at = module.global_variables.get_span(handle).to_range();
        let (mut components, mut is_set) = (Vec::new(), Vec::new());
        for (index, member) in members.into_iter().enumerate() {
            let is_taken = taken.get(&handle).is_some_and(|members| members.contains(&index));
            let key = member.name.clone().unwrap_or_default();
            let written = settings.remove(&format!("{name}.{key}")).or_else(|| settings.remove(&key));
            is_set.push(written.is_some() || is_taken);
            let init = match written {
                None => module.global_expressions.append(Expression::ZeroValue(member.ty), Span::UNDEFINED),
                Some(written) => {
                    let inner = &module.types[member.ty].inner;
                    let value = Constant::parse(&key, inner, &written);
                    let value = value.map_err(|error| Fault::new(error).at(at.clone()))?;
                    value.append(member.ty, module)
                }
            };
            components.push(init);
        }
        let init = module.global_expressions.append(Expression::Compose { ty, components }, Span::UNDEFINED);
        let variable = &mut module.global_variables[handle];
        (variable.space, variable.binding, variable.init) = (AddressSpace::Private, None, Some(init));
        blocks.insert(name, is_set);
    }
    Ok(blocks)
}

/// Refuses what reads a member without a value, or a block as a whole that has such a member.
pub(super) fn refuse_unset(module: &Module, blocks: &BTreeMap<String, Vec<bool>>) -> Result<(), Fault> {
    for (_, function) in module.functions.iter() {
        for (place, expression) in function.expressions.iter() {
            let Expression::GlobalVariable(handle) = *expression else { continue };
            let variable = &module.global_variables[handle];
            let Some((name, members)) = structure(module, variable) else { continue };
            let Some(is_set) = blocks.get(&name) else { continue };
            let reads = members_read(function, place);
            let unset = members.iter().zip(is_set).enumerate().find(|&(index, (_, is_set))| {
                !is_set && reads.iter().any(|&(read, _)| read.is_none_or(|read| read == index))
            });
            let Some((index, (member, _))) = unset else { continue };
            let key = member.name.clone().unwrap_or_default();
            let message = match Constant::form(&module.types[member.ty].inner) {
                Some(form) => {
                    // The block of HLSL in which uniforms outside of all blocks are.
                    let typed = if name.starts_with('$') { key.clone() } else { format!("{name}.{key}") };
                    format!("`{key}` of uniform block `{name}` has no value: --set {typed}={form}")
                }
                None => format!(
                    "`{key}` of uniform block `{name}`, of type {}, has no value, and --set gives one to numbers and vectors \
                     only: make what is read of it a parameter",
                    described(module, member.ty)
                ),
            };
            let read = reads.iter().find(|&&(read, _)| read.is_none_or(|read| read == index));
            let at = read.and_then(|&(_, at)| function.expressions.get_span(at).to_range());
            return Err(Fault::new(message).at(at.or(module.global_variables.get_span(handle).to_range())));
        }
    }
    Ok(())
}

/// The members of a variable that a function reads, none for all of them, and by which expression.
fn members_read(
    function: &Function,
    variable: Handle<Expression>,
) -> Vec<(Option<usize>, Handle<Expression>)> {
    let is_load =
        |expression: &Expression| matches!(*expression, Expression::Load { pointer } if pointer == variable);
    let is_block = |at| at == variable || is_load(&function.expressions[at]);
    let member = |(at, expression): (_, &Expression)| match *expression {
        Expression::AccessIndex { base, index } if is_block(base) => Some((Some(index as usize), at)),
        _ if is_load(expression) && is_handed_on(function, at) => Some((None, at)),
        _ => None,
    };
    function.expressions.iter().filter_map(member).collect()
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
