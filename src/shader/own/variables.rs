//! Variables of a module and where their values come from: a user's setting, the text, or nowhere.

use super::error::Fault;
use super::setting::{Constant, Value};
use super::signature;
use naga::back::PipelineConstants;
use naga::{AddressSpace, Expression, Function, GlobalVariable, Handle, Module, Statement, TypeInner};
use std::collections::{BTreeMap, BTreeSet};

/// Makes uniforms that are numbers or vectors private variables that begin with the value that `settings` has for them.
/// Those without a value stay, and are refused where the function reads them.
///
/// # Errors
///
/// A value of another type.
pub(super) fn fill_uniforms(
    module: &mut Module,
    uniforms: &[String],
    settings: &mut BTreeMap<String, String>,
) -> Result<(), Fault> {
    let handles: Vec<_> = module.global_variables.iter().map(|(handle, _)| handle).collect();
    for handle in handles {
        let variable = &module.global_variables[handle];
        let Some(name) = variable.name.clone() else { continue };
        let is_uniform = variable.space == AddressSpace::Uniform || uniforms.contains(&name);
        let inner = &module.types[variable.ty].inner;
        if !is_uniform || Constant::form(inner).is_none() {
            continue;
        }
        let written = match settings.remove(&name) {
            Some(written) => written,
            None if name == "hash_scale" && variable.init.is_none() => "1".to_owned(),
            None => continue,
        };
        let at = module.global_variables.get_span(handle).to_range();
        let value = Constant::parse(&name, inner, &written).map_err(|error| Fault::new(error).at(at))?;
        let ty = variable.ty;
        let init = value.append(ty, module);
        let variable = &mut module.global_variables[handle];
        variable.space = AddressSpace::Private;
        variable.binding = None;
        variable.init = Some(init);
    }
    Ok(())
}

/// Returns the values of overrides by the keys that naga knows them by.
pub(super) fn overrides(
    module: &Module,
    settings: &mut BTreeMap<String, String>,
) -> Result<PipelineConstants, Fault> {
    let mut values = PipelineConstants::default();
    for (handle, constant) in module.overrides.iter() {
        let Some(name) = &constant.name else { continue };
        let TypeInner::Scalar(scalar) = module.types[constant.ty].inner else { continue };
        let Some(written) = settings.remove(name) else { continue };
        let at = module.overrides.get_span(handle).to_range();
        let value = Value::parse(scalar, &written)
            .map_err(|error| Fault::new(format!("`{name}`: {error}")).at(at))?;
        values.insert(constant.id.map_or_else(|| name.clone(), |id| id.to_string()), value.to_f64());
    }
    Ok(values)
}

/// Refuses what a function by itself cannot read.
pub(super) fn refuse_resources(
    module: &Module,
    filled: &BTreeSet<String>,
    uniforms: &[String],
) -> Result<(), Fault> {
    for (handle, variable) in module.global_variables.iter() {
        let name = variable.name.as_deref().unwrap_or("a variable");
        let is_uniform = uniforms.iter().any(|uniform| uniform == name) && variable.init.is_none();
        let problem = if variable.space == AddressSpace::Uniform || is_uniform {
            match Constant::form(&module.types[variable.ty].inner) {
                Some(form) => format!("uniform `{name}` has no value: --set {name}={form}"),
                None => format!(
                    "uniform `{name}`, of type {}, has no value, and --set gives one to numbers and vectors only: make \
                     what is read of it a parameter",
                    signature::described(module, variable.ty)
                ),
            }
        } else if variable.space != AddressSpace::Private {
            format!(
                "`{name}` is a texture, buffer or shared memory, which is not there when the function runs alone: make what \
                 is read of it a parameter"
            )
        } else if filled.contains(name) {
            format!(
                "`{name}` is filled before `main` starts, as an input or by a computed initial value, but `main` does not \
                 run: say --map position={name} where it is the position; otherwise make it a parameter or a constant"
            )
        } else {
            continue;
        };
        return Err(Fault::new(problem).at(module.global_variables.get_span(handle).to_range()));
    }
    Ok(())
}

/// Refuses variables that are read and never written.
pub(super) fn refuse_undefined(module: &Module, function: &str, ours: &[String]) -> Result<(), Fault> {
    let written: BTreeSet<_> =
        module.functions.iter().flat_map(|(_, function)| written_by(function)).collect();
    for (handle, variable) in module.global_variables.iter() {
        let name = variable.name.as_deref().unwrap_or("a variable");
        let is_ours = ours.iter().any(|our| our == name);
        if variable.init.is_none() && !written.contains(&handle) && !is_ours {
            let message = format!(
                "`{name}` has no value: nothing that `{function}` comes to writes it; make it a parameter, a constant, or \
                 a uniform with --set"
            );
            return Err(Fault::new(message).at(module.global_variables.get_span(handle).to_range()));
        }
    }
    Ok(())
}

/// The variables that a function writes, or hands on by their place.
pub(super) fn written_by(function: &Function) -> Vec<Handle<GlobalVariable>> {
    let mut places = Vec::new();
    let mut blocks = vec![&function.body];
    while let Some(block) = blocks.pop() {
        for statement in block.iter() {
            match statement {
                Statement::Store { pointer, .. } => places.push(*pointer),
                Statement::Call { arguments, .. } => places.extend(arguments),
                Statement::Block(inner) => blocks.push(inner),
                Statement::If { accept, reject, .. } => blocks.extend([accept, reject]),
                Statement::Switch { cases, .. } => blocks.extend(cases.iter().map(|case| &case.body)),
                Statement::Loop { body, continuing, .. } => blocks.extend([body, continuing]),
                _ => {}
            }
        }
    }
    let variable = |mut place| loop {
        match function.expressions[place] {
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => place = base,
            Expression::GlobalVariable(variable) => return Some(variable),
            _ => return None,
        }
    };
    places.into_iter().filter_map(variable).collect()
}
