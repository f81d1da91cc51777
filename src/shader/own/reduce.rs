//! From a whole module to one function whose every input has a value.

use super::error::Fault;
use super::setting::Value;
use super::signature::{self, Binding};
use super::{Front, Options, derivative, validate};
use naga::back::PipelineConstants;
use naga::back::pipeline_constants::{PipelineConstantError, process_overrides};
use naga::valid::ModuleInfo;
use naga::{
    AddressSpace, Block, EntryPoint, Expression, Function, Handle, Module, ShaderStage, Span, Statement,
    TypeInner,
};
use std::collections::{BTreeMap, BTreeSet};

/// What is left of a module.
pub(super) struct Reduced {
    pub module: Module,
    pub info: ModuleInfo,
    pub function: String,
    pub bindings: Vec<Binding>,
}

/// The name of the function afterwards; no language renames it.
const NAME: &str = "own_threshold";

/// What stands before every other name of the module afterwards, so that none meets one of the text around it.
const PREFIX: &str = "its_";

/// Keeps the function that is asked for and what it reads, with every value filled in.
pub(super) fn reduce(front: Front, options: &Options) -> Result<Reduced, Fault> {
    let Front { mut module, uniforms, initialised, defined, has_derivatives } = front;
    let mut settings = options.settings.clone();
    settings.retain(|name, _| !defined.contains(name));
    let stage_inputs = filled_before_main(&module, &initialised);
    let mut target = find(&module, &options.function)?;
    if has_derivatives {
        target = derivative::wrap(&mut module, target);
    }
    let bindings = signature::bind(&module, target, &options.function, &mut settings)?;
    fill_uniforms(&mut module, &uniforms, &mut settings)?;
    let constants = overrides(&module, &mut settings)?;
    if let Some(name) = settings.keys().next() {
        return Err(Fault::new(format!(
            "nothing that `{name}` could set: no uniform, no override, and no parameter of `{}` has that name",
            options.function
        )));
    }
    rename_functions(&mut module, target);
    keep_only(&mut module, target);
    let info = validate(&module)?;
    let (module, _) = process_overrides(&module, &info, None, &constants).map_err(|error| match error {
        PipelineConstantError::MissingValue(key) => {
            // One with a number is known to naga by that alone.
            let numbered =
                module.overrides.iter().find(|(_, o)| o.id.is_some_and(|id| id.to_string() == key));
            let name = numbered.and_then(|(_, constant)| constant.name.clone()).unwrap_or(key);
            Fault::new(format!("override `{name}` has no value: --set {name}=VALUE"))
        }
        error => Fault::new(error.to_string()),
    })?;
    let mut module = module.into_owned();
    naga::compact::compact(&mut module, naga::compact::KeepUnused::No);
    module.entry_points.clear();
    refuse_resources(&module, &stage_inputs, &uniforms)?;
    rename_the_rest(&mut module);
    let info = validate(&module)?;
    Ok(Reduced { module, info, function: NAME.to_owned(), bindings })
}

fn find(module: &Module, name: &str) -> Result<Handle<Function>, Fault> {
    let mut named = module
        .functions
        .iter()
        .filter(|(_, function)| function.name.as_deref() == Some(name))
        .map(|(handle, _)| handle);
    match (named.next(), named.next()) {
        (Some(function), None) => Ok(function),
        (Some(_), Some(second)) => Err(Fault::new(format!("there are several functions `{name}`"))
            .at(module.functions.get_span(second).to_range())),
        (None, _) => {
            let known: BTreeSet<_> = module
                .functions
                .iter()
                .filter_map(|(_, function)| function.name.as_deref())
                .filter(|&name| name != "main")
                .collect();
            let known: Vec<_> = known.into_iter().collect();
            let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
            Err(Fault::new(format!(
                "there is no function `{name}`; functions are {known}; {}",
                signature::allowed()
            )))
        }
    }
}

/// Variables of a GLSL file that get their value before `main` starts: inputs of the stage, and those whose initial value
/// naga could not compute.
fn filled_before_main(module: &Module, initialised: &[String]) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for (_, variable) in module.global_variables.iter() {
        let name = variable.name.clone().filter(|name| variable.init.is_none() && initialised.contains(name));
        names.extend(name);
    }
    for entry in &module.entry_points {
        for statement in entry.function.body.iter() {
            if let Statement::Store { pointer, .. } = *statement
                && let Expression::GlobalVariable(variable) = entry.function.expressions[pointer]
            {
                names.extend(module.global_variables[variable].name.clone());
            }
        }
    }
    names
}

/// Makes uniforms of one value private variables that begin with that value. Those without a value stay, and are
/// refused where the function reads them.
fn fill_uniforms(
    module: &mut Module,
    uniforms: &[String],
    settings: &mut BTreeMap<String, String>,
) -> Result<(), Fault> {
    for (_, variable) in module.global_variables.iter_mut() {
        let Some(name) = variable.name.clone() else { continue };
        let is_uniform = variable.space == AddressSpace::Uniform || uniforms.contains(&name);
        let TypeInner::Scalar(scalar) = module.types[variable.ty].inner else { continue };
        if !is_uniform {
            continue;
        }
        let written = match settings.remove(&name) {
            Some(written) => written,
            None if name == "hash_scale" && variable.init.is_none() => "1".to_owned(),
            None => continue,
        };
        let value = Value::parse(scalar, &written).map_err(|error| Fault::new(format!("{name}: {error}")))?;
        let literal = module.global_expressions.append(Expression::Literal(value.literal()), Span::UNDEFINED);
        variable.space = AddressSpace::Private;
        variable.binding = None;
        variable.init = Some(literal);
    }
    Ok(())
}

/// Returns the values of overrides by the keys that naga knows them by.
fn overrides(module: &Module, settings: &mut BTreeMap<String, String>) -> Result<PipelineConstants, Fault> {
    let mut values = PipelineConstants::default();
    for (handle, constant) in module.overrides.iter() {
        let Some(name) = &constant.name else { continue };
        let TypeInner::Scalar(scalar) = module.types[constant.ty].inner else { continue };
        let Some(written) = settings.remove(name) else { continue };
        let at = module.overrides.get_span(handle).to_range();
        let value =
            Value::parse(scalar, &written).map_err(|error| Fault::new(format!("{name}: {error}")).at(at))?;
        values.insert(constant.id.map_or_else(|| name.clone(), |id| id.to_string()), value.to_f64());
    }
    Ok(values)
}

fn rename_functions(module: &mut Module, target: Handle<Function>) {
    for (handle, function) in module.functions.iter_mut() {
        function.name = Some(match function.name.take() {
            _ if handle == target => NAME.to_owned(),
            name => prefixed(name),
        });
    }
}

/// Renames what messages and values no longer need by its name: variables, constants and structures.
fn rename_the_rest(module: &mut Module) {
    for (_, variable) in module.global_variables.iter_mut() {
        variable.name = Some(prefixed(variable.name.take()));
    }
    for (_, constant) in module.constants.iter_mut() {
        constant.name = Some(prefixed(constant.name.take()));
    }
    let structures: Vec<_> = module
        .types
        .iter()
        // Two underscores are naga's own.
        .filter(|(_, ty)| ty.name.as_ref().is_some_and(|name| !name.starts_with("__")))
        .map(|(handle, ty)| {
            (handle, naga::Type { name: Some(prefixed(ty.name.clone())), inner: ty.inner.clone() })
        })
        .collect();
    for (handle, ty) in structures {
        module.types.replace(handle, ty);
    }
}

fn prefixed(name: Option<String>) -> String {
    format!("{PREFIX}{}", name.unwrap_or_default())
}

/// Puts an entry point that calls `target` in the place of all others.
fn keep_only(module: &mut Module, target: Handle<Function>) {
    let called = &module.functions[target];
    let mut function = Function::default();
    let arguments = called
        .arguments
        .iter()
        .map(|argument| function.expressions.append(Expression::ZeroValue(argument.ty), Span::UNDEFINED))
        .collect();
    let result = function.expressions.append(Expression::CallResult(target), Span::UNDEFINED);
    let call = Statement::Call { function: target, arguments, result: Some(result) };
    function.body = Block::from_vec(vec![call, Statement::Return { value: None }]);
    module.entry_points = vec![EntryPoint {
        name: "entry".to_owned(),
        stage: ShaderStage::Fragment,
        early_depth_test: None,
        workgroup_size: [0; 3],
        workgroup_size_overrides: None,
        function,
        mesh_info: None,
        task_payload: None,
        incoming_ray_payload: None,
    }];
}

/// Refuses what a function by itself cannot read.
fn refuse_resources(
    module: &Module,
    stage_inputs: &BTreeSet<String>,
    uniforms: &[String],
) -> Result<(), Fault> {
    for (handle, variable) in module.global_variables.iter() {
        let name = variable.name.as_deref().unwrap_or("a variable");
        let kind = signature::described(module, variable.ty);
        let problem = if variable.space == AddressSpace::Uniform
            || uniforms.iter().any(|uniform| uniform == name) && variable.init.is_none()
        {
            format!(
                "uniform `{name}` has no value: --set {name}=VALUE gives one to f32, i32, u32 and bool; this is {kind}"
            )
        } else if variable.space != AddressSpace::Private {
            format!(
                "`{name}` is a texture, buffer or shared memory, which is not there when the function runs alone"
            )
        } else if stage_inputs.contains(name) {
            format!(
                "`{name}` is filled before `main` starts, as an input or by a computed initial value, but `main` does not \
                 run; make it a parameter or a constant"
            )
        } else {
            continue;
        };
        return Err(Fault::new(problem).at(module.global_variables.get_span(handle).to_range()));
    }
    Ok(())
}
