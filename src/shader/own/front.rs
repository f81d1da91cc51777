//! A module as its front end read it, and what of its text the module does not tell.

use super::error::Fault;
use super::invalid::validate;
use naga::{Expression, Module, Statement};
use std::collections::{BTreeMap, BTreeSet};

/// A module that is valid as a whole.
pub(super) struct Front {
    pub module: Module,
    /// Names of variables that get their value before `main` starts, or from it: inputs of the stage, and those whose
    /// initial value naga could not compute.
    pub filled: BTreeSet<String>,
    /// Names of variables that wait for a value.
    pub uniforms: Vec<String>,
    /// Settings that were macros.
    pub defined: Vec<String>,
    /// Functions of the text, those that are not in the module too; each with the condition that it stands behind.
    pub functions: BTreeMap<String, Option<String>>,
    /// Whether a variable without an initial value holds nothing, as in GLSL, or zero.
    pub begins_undefined: bool,
    pub has_derivatives: bool,
    /// Whether a parameter that is a pointer stands for a copy, as a compiler of GLSL writes `in`.
    pub takes_copies: bool,
}

impl Front {
    pub fn plain(module: Module, has_derivatives: bool) -> Self {
        let filled = filled_by_entry_points(&module);
        let names = module.functions.iter().filter_map(|(_, function)| function.name.clone());
        let functions = names.map(|name| (name, None)).collect();
        Self {
            module,
            filled,
            uniforms: Vec::new(),
            defined: Vec::new(),
            functions,
            begins_undefined: false,
            has_derivatives,
            takes_copies: false,
        }
    }
}

/// Names of variables that an entry point writes.
pub(super) fn filled_by_entry_points(module: &Module) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
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

pub(super) fn read_spir_v(bytes: &[u8]) -> Result<Front, Fault> {
    let options = naga::front::spv::Options { strict_capabilities: false, ..Default::default() };
    let mut module =
        naga::front::spv::parse_u8_slice(bytes, &options).map_err(|error| Fault::new(error.to_string()))?;
    validate(&module)?;
    for (_, function) in module.functions.iter_mut() {
        // glslang puts the types of the parameters behind the name.
        if let Some((name, _)) = function.name.as_deref().and_then(|name| name.split_once('(')) {
            function.name = Some(name.to_owned());
        }
    }
    Ok(Front { takes_copies: true, ..Front::plain(module, false) })
}
