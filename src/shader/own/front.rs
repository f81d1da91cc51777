//! A module as its front end read it, and what of its text the module does not tell.

use super::derivative::Variables;
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
    /// The variables that took the place of derivatives.
    pub derivatives: Option<Variables>,
    /// Whether a parameter that is a pointer stands for a copy, as a compiler of GLSL writes `in`.
    pub takes_copies: bool,
}

impl Front {
    pub fn plain(module: Module, derivatives: Option<Variables>) -> Self {
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
            derivatives,
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
    let bytes = without_lines(bytes);
    let mut module =
        naga::front::spv::parse_u8_slice(&bytes, &options).map_err(|error| Fault::new(error.to_string()))?;
    validate(&module)?;
    for (_, function) in module.functions.iter_mut() {
        // glslang puts the types of the parameters behind the name.
        if let Some((name, _)) = function.name.as_deref().and_then(|name| name.split_once('(')) {
            function.name = Some(name.to_owned());
        }
    }
    Ok(Front { takes_copies: true, ..Front::plain(module, None) })
}

/// Leaves out the instructions that tell lines of a source, which naga does not take everywhere; what is no module stays.
fn without_lines(bytes: &[u8]) -> Vec<u8> {
    const HEADER: usize = 20;
    const LINES: [u16; 2] = [8, 317]; // OpLine, OpNoLine
    let Some((header, mut rest)) = bytes.split_at_checked(HEADER) else { return bytes.to_vec() };
    // The magic number is written in the order of the bytes.
    let is_little = header.starts_with(&[3, 2, 0x23, 7]);
    let half = |at: &[u8]| {
        let pair = [at[0], at[1]];
        if is_little { u16::from_le_bytes(pair) } else { u16::from_be_bytes(pair) }
    };
    let mut kept = header.to_vec();
    while rest.len() >= 4 {
        let (operation, words) =
            if is_little { (half(rest), half(&rest[2..])) } else { (half(&rest[2..]), half(rest)) };
        let length = (usize::from(words).max(1) * 4).min(rest.len());
        if !LINES.contains(&operation) {
            kept.extend(&rest[..length]);
        }
        rest = &rest[length..];
    }
    kept.extend(rest);
    kept
}
