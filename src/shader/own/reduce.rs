//! From a whole module to one function whose every input has a value.

use super::error::Fault;
use super::front::Front;
use super::invalid::{self, validate, validate_plain};
use super::mapping::{self, Mapped, Taken};
use super::options::Options;
use super::signature::{self, Binding};
use super::variables::{fill_uniforms, overrides, refuse_resources, refuse_undefined};
use super::{bisection, blocks, derivative, pointers, quads};
use crate::shader::spelling::likely;
use naga::back::pipeline_constants::{PipelineConstantError, process_overrides};
use naga::valid::ModuleInfo;
use naga::{Block, EntryPoint, Expression, Function, Handle, Module, ShaderStage, Span, Statement};
use std::collections::{BTreeMap, BTreeSet};

/// What is left of a module.
pub(super) struct Reduced {
    pub module: Module,
    pub info: ModuleInfo,
    pub function: String,
    pub bindings: Vec<Binding>,
    pub taken: Vec<Taken>,
    /// What was done with a test of an alpha, where it was one.
    pub bisected: Option<String>,
}

/// The name of the function afterwards; no language renames it.
const NAME: &str = "own_threshold";

/// What stands before every other name of the module afterwards, so that none meets one of the text around it.
const PREFIX: &str = "its_";

/// Keeps the function that is asked for and what it reads, with every value filled in.
pub(super) fn reduce(front: Front, options: &Options, pixels: &BTreeSet<String>) -> Result<Reduced, Fault> {
    let Front {
        mut module,
        mut filled,
        mut uniforms,
        defined,
        functions,
        begins_undefined,
        derivatives,
        takes_copies,
    } = front;
    let mut settings = options.settings.clone();
    settings.retain(|name, _| !defined.contains(name));
    let own = find(&module, &options.function, &functions)?;
    let (mut target, bisected) = bisection::wrap(&mut module, own, options, &settings)?;
    if let Some(variables) = &derivatives {
        target = derivative::wrap(&mut module, target, variables);
    }
    if takes_copies {
        target = pointers::wrap(&mut module, target);
    }
    let Mapped { target, notes: taken, names, members } =
        mapping::map(&mut module, target, options, &mut settings, &filled, &uniforms, pixels)?;
    uniforms.retain(|name| !names.contains(name));
    filled.retain(|name| !names.contains(name));
    let target = quads::wrap(&mut module, target);
    let its_name = if target == own { NAME.to_owned() } else { prefixed(Some(options.function.clone())) };
    let bindings = signature::bind(&module, target, &options.function, &mut settings)?;
    fill_uniforms(&mut module, &uniforms, &mut settings)?;
    let blocks = blocks::fill(&mut module, &mut settings, &uniforms, &members)?;
    let constants = overrides(&module, &mut settings)?;
    if let Some(name) = settings.keys().next() {
        let waiting = waiting(&module, target);
        let likely = likely(name, &waiting);
        let waiting = if waiting.is_empty() { "nothing".to_owned() } else { waiting.join(", ") };
        return Err(Fault::new(format!(
            "nothing that `{name}` could set: no uniform, no override, and no parameter of `{}` has that name.{likely} What has a value \
             from outside is {waiting}",
            options.function
        )));
    }
    rename_functions(&mut module, target);
    keep_only(&mut module, target);
    let in_words = |fault: Fault| Fault { message: unprefixed(&fault.message, &options.function), ..fault };
    let info = validate(&module).map_err(in_words)?;
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
    derivative::refuse_others(&module, &its_name, &options.function)?;
    refuse_discard(&module)?;
    blocks::refuse_unset(&module, &blocks)?;
    refuse_resources(&module, &filled, &uniforms)?;
    if begins_undefined {
        refuse_undefined(&module, &options.function, derivatives.as_ref().map_or(&[], |ours| &ours[..]))?;
    }
    rename_the_rest(&mut module);
    let info = validate_plain(&module).map_err(in_words)?;
    Ok(Reduced { module, info, function: NAME.to_owned(), bindings, taken, bisected })
}

/// What a value can be given to: parameters, uniforms and members of their blocks, and overrides.
fn waiting(module: &Module, target: Handle<Function>) -> Vec<String> {
    let parameters = module.functions[target].arguments.iter().filter_map(|argument| argument.name.clone());
    let uniforms = module.global_variables.iter().filter(|(_, variable)| {
        matches!(variable.space, naga::AddressSpace::Uniform | naga::AddressSpace::Immediate)
    });
    let uniforms = uniforms.flat_map(|(_, variable)| {
        let name = variable.name.clone().unwrap_or_default();
        match &module.types[variable.ty].inner {
            naga::TypeInner::Struct { members, .. } => members
                .iter()
                .filter_map(|member| Some(format!("{name}.{}", member.name.as_ref()?)))
                .collect(),
            _ => vec![name],
        }
    });
    let overrides = module.overrides.iter().filter_map(|(_, constant)| constant.name.clone());
    parameters.chain(uniforms).chain(overrides).collect()
}

/// Refuses a fragment that is discarded: what runs here answers with a threshold.
fn refuse_discard(module: &Module) -> Result<(), Fault> {
    let is_discard = |statement: &Statement| matches!(statement, Statement::Kill);
    let found = module.functions.iter().find_map(|(_, function)| invalid::find(&function.body, &is_discard));
    found.map_or(Ok(()), |at| {
        Err(Fault::new("a threshold cannot `discard`; return it, and compare outside").at(Some(at)))
    })
}

fn find(
    module: &Module,
    name: &str,
    functions: &BTreeMap<String, Option<String>>,
) -> Result<Handle<Function>, Fault> {
    let all = module.functions.iter().filter(|(_, function)| function.name.as_deref() == Some(name));
    let all: Vec<_> = all.map(|(handle, _)| handle).collect();
    // Of several the one that hands on to the others.
    let is_called = |handle: &Handle<Function>| {
        all.iter().any(|other| invalid::called_by(&module.functions[*other].body).contains(handle))
    };
    let mut named = all.iter().copied().filter(|handle| !is_called(handle));
    match (named.next(), named.next()) {
        (Some(function), None) => Ok(function),
        (Some(_), Some(second)) => Err(Fault::new(format!("there are several functions `{name}`"))
            .at(module.functions.get_span(second).to_range())),
        (None, _) => Err(Fault::absent(signature::absent(name, functions))),
    }
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

/// A message with the names of the file in the place of ours.
fn unprefixed(message: &str, function: &str) -> String {
    message.replace(&format!("`{NAME}`"), &format!("`{function}`")).replace(&format!("`{PREFIX}"), "`")
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
