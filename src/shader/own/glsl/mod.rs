//! GLSL of any version: prepared byte for byte, then read as the GLSL 450 that naga knows.

mod macros;
mod prepare;
mod words;

use super::directives;
use super::error::Fault;
use super::front::{Front, filled_by_entry_points};
use super::invalid::{CIRCLE, validate};
use super::isolated::isolated;
use super::items;
use super::options::Options;
use super::scan::{Token, end_of_file, tokens};
use super::signature::without_test;
use naga::front::glsl::Frontend;

/// Blanks what a function of a text in this language or one like it does not come to, and lines of `#include`; nothing moves. Returns
/// the settings that are macros, too.
///
/// # Errors
///
/// A condition without an end, and an end of none.
pub(super) fn reached(
    text: &str,
    tokens: &[Token],
    asked: &Options,
) -> Result<(String, Vec<(String, String)>), Fault> {
    let directives = directives::directives(text, tokens);
    directives::functions(text, tokens, &directives)?;
    let mut bytes = text.as_bytes().to_vec();
    for directive in directives.iter().filter(|directive| directive.name() == "include") {
        bytes[directive.at.clone()].iter_mut().filter(|byte| **byte != b'\n').for_each(|byte| *byte = b' ');
    }
    items::blank_others(&mut bytes, text, tokens, &directives, &asked.function, &asked.names());
    let settings = asked.settings.iter().filter(|(name, _)| directives::is_asked_for(&directives, name));
    let defines = settings.map(|(name, value)| (name.clone(), value.clone())).collect();
    // Nothing but whole tokens was replaced.
    Ok((String::from_utf8_lossy(&bytes).into_owned(), defines))
}

/// Reads a text; `prelude` becomes the number of bytes that stand before it in what naga reads.
///
/// # Errors
///
/// Text that is no GLSL or not valid.
pub(super) fn read(text: &str, asked: &Options, prelude: &mut usize) -> Result<Front, Fault> {
    if asked.function == "main" {
        return Err(Fault::new(without_test(&asked.function)));
    }
    let tokens = tokens(text)?;
    let directives = directives::directives(text, &tokens);
    let functions = directives::functions(text, &tokens, &directives)?;
    let prepared = prepare::prepare(text, &tokens, &directives, asked)?;
    *prelude = prepared.prelude;
    let (before, length) = (prepared.prelude, text.trim_end().len());
    // What messages quote: the user's own words, at the places that naga names.
    let shown = {
        let (front, back) = (&prepared.text[..before], &prepared.text[before + text.len()..]);
        [front, text, back].concat()
    };
    let read = isolated(move || {
        let mut options = naga::front::glsl::Options::from(naga::ShaderStage::Fragment);
        options.defines.extend(prepared.defines.iter().cloned());
        let parsed = Frontend::default().parse(&options, &prepared.text);
        let mut module = parsed.map_err(|errors| words::said(&errors, &shown, &prepared.textures))?;
        let is_unset = |variable: &naga::GlobalVariable| variable.init.is_none();
        let computed = module.global_variables.iter().filter(|(_, variable)| is_unset(variable));
        let mut filled: std::collections::BTreeSet<_> = computed
            .filter_map(|(_, v)| v.name.clone())
            .filter(|name| prepared.initialised.contains(name))
            .collect();
        filled.extend(filled_by_entry_points(&module));
        // Nothing draws: what inputs and outputs are bound to does not matter.
        module.entry_points.clear();
        validate(&module)?;
        Ok(Front {
            module,
            filled,
            uniforms: prepared.uniforms,
            defined: prepared.defined,
            functions,
            begins_undefined: true,
            derivatives: prepared.derivatives,
            takes_copies: false,
        })
    });
    // A function is unknown until its end.
    let is_own_name = |fault: &Fault| {
        let name = fault.message.strip_prefix("Unknown function '")?.strip_suffix('\'')?;
        let place = fault.at.as_ref()?.start.checked_sub(before)?;
        let token = tokens.iter().find(|token| token.at.end > place)?;
        Some(&text[tokens[token.function?].at.clone()] == name)
    };
    read.map_err(|fault| match &fault.at {
        at if is_own_name(&fault) == Some(true) => Fault::new(CIRCLE).at(at.clone()),
        Some(at) if at.start >= before + length => {
            let shifted = |at: core::ops::Range<usize>| at.start + before..at.end + before;
            end_of_file(text, &tokens).map_or(fault, |open| Fault { at: open.at.map(shifted), ..open })
        }
        _ => words::or_included(fault, &directives),
    })
}
