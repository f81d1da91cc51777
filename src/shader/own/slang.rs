//! Slang, by way of its own compiler, whose WGSL naga reads.

use super::compiler::{Folder, line_of, not_handed, run};
use super::directives::directives;
use super::error::Fault;
use super::front::Front;
use super::glsl;
use super::hlsl::{Head, Parameter, head};
use super::invalid::validate;
use super::isolated::isolated;
use super::items;
use super::options::Options;
use super::scan::tokens;
use naga::{Module, TypeInner};
use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::path::Path;

/// The program of Slang.
const COMPILER: &str = "slangc";

/// What the compiler says of a file that is nowhere.
const MISSING: &str = "cannot open file";

/// The entry point that calls the function: what nothing calls is left out.
const ENTRY: &str = "hashed_alpha_entry";

/// Reads a text; functions that the one on trial does not come to are left out. Modules that it imports are looked for in `folder` and
/// where [`Options::include`] says.
///
/// # Errors
///
/// No such function, no compiler, and what the compiler says.
pub(super) fn read(text: &str, asked: &Options, folder: Option<&Path>) -> Result<Front, Fault> {
    let tokens = tokens(text)?;
    let head = head(text, &tokens, &asked.function)?;
    let (prepared, defines) = glsl::reached(text, &tokens, asked)?;
    let folders = folder.into_iter().chain(asked.include.iter().map(AsRef::as_ref));
    let folders: Vec<_> = folders.collect();
    let mut prepared = prepared + &entry(&asked.function, &head);
    // What an engine has elsewhere is missed only where something of it is.
    let mut missing = None;
    let wgsl = loop {
        let fault = match compiled(&prepared, &defines, &folders, text) {
            Ok(wgsl) => break wgsl,
            Err(fault) => fault,
        };
        let import = fault.at.clone().filter(|_| fault.message.contains(MISSING));
        let Some(import) = import.filter(|at| prepared[at.clone()].contains("import")) else {
            let before = missing.map_or(String::new(), |missing: String| format!("; {missing}"));
            return Err(Fault { message: fault.message + &before, ..fault });
        };
        prepared.replace_range(import.clone(), &" ".repeat(import.len()));
        missing.get_or_insert(fault.message);
    };
    let function = asked.function.clone();
    let front = isolated(move || module(&wgsl, &function))?;
    let defined = defines.into_iter().map(|(name, _)| name).collect();
    Ok(Front { defined, ..front })
}

/// An entry point that calls a function in such a way that nothing of it is known beforehand and nothing of it is in vain.
fn entry(function: &str, Head { parameters, result }: &Head<'_>) -> String {
    let member = |(index, Parameter { ty, .. }): (usize, &Parameter<'_>)| format!("{ty} a{index}; ");
    let given: String = parameters.iter().enumerate().map(member).collect();
    let is_out = |(_, parameter): &(usize, &Parameter<'_>)| parameter.is_out;
    let mut found: String = parameters.iter().enumerate().filter(is_out).map(member).collect();
    let handed: Vec<_> = (0..parameters.len()).map(|index| format!("given.a{index}")).collect();
    let mut call = format!("{function}({});", handed.join(", "));
    if *result != "void" {
        found += &format!("{result} value; ");
        call = format!("found.value = {call}");
    }
    let kept: String = parameters
        .iter()
        .enumerate()
        .filter(is_out)
        .map(|(index, _)| format!(" found.a{index} = given.a{index};"))
        .collect();
    format!(
        "
struct HashedAlphaGiven {{ {given}float hashed_alpha_unused; }}
struct HashedAlphaFound {{ {found}float hashed_alpha_unused; }}
ConstantBuffer<HashedAlphaGiven> hashed_alpha_given;
RWStructuredBuffer<HashedAlphaFound> hashed_alpha_found;
[shader(\"fragment\")]
float4 {ENTRY}() : SV_Target {{ HashedAlphaGiven given = hashed_alpha_given; HashedAlphaFound found; {call}{kept} \
hashed_alpha_found[0] = found; return float4(0, 0, 0, 0); }}
"
    )
}

/// Compiles a prepared text to WGSL; `text` is what the user wrote.
fn compiled(
    prepared: &str,
    defines: &[(String, String)],
    folders: &[&Path],
    text: &str,
) -> Result<String, Fault> {
    let io = |error| not_handed("Slang", &error);
    let folder = Folder::new("Slang")?;
    let (source, module) = (folder.file("shader.slang"), folder.file("shader.wgsl"));
    std::fs::write(&source, prepared).map_err(io)?;
    let mut arguments = vec![source.clone().into_os_string()];
    let plain = ["-target", "wgsl", "-O0", "-entry", ENTRY, "-stage", "fragment", "-o"];
    arguments.extend(plain.map(OsString::from));
    arguments.push(module.clone().into());
    arguments.extend(defines.iter().map(|(name, value)| OsString::from(format!("-D{name}={value}"))));
    for folder in folders {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { *folder };
        arguments.extend([OsString::from("-I"), folder.into()]);
    }
    let missing = format!(
        "Slang is read by {COMPILER}, which is not in PATH: install a release of Slang or the Vulkan SDK, or hand over what \
         `{COMPILER} -target wgsl` makes elsewhere"
    );
    let output = run(COMPILER, arguments, &missing)?;
    if !output.status.success() {
        let all = [output.stderr, output.stdout].concat();
        return Err(said(&String::from_utf8_lossy(&all), text));
    }
    std::fs::read_to_string(&module).map_err(io)
}

/// The first error of the compiler at the user's line.
///
/// It is written as `shader.slang(3): error 30015: undefined identifier`, or, since 2026, in lines of which the one with ` --> ` has the place
/// and one that points at the text has the message.
fn said(output: &str, text: &str) -> Fault {
    let mut lines = output.lines().skip_while(|line| !line.contains("error"));
    let Some(first) = lines.next() else { return Fault::new(format!("{COMPILER} fails: {}", output.trim())) };
    let advice = |message: &str| {
        let is_missing = message.contains(MISSING);
        if is_missing { format!("{message} -I DIR names a folder to look in") } else { message.to_owned() }
    };
    if let Some((place, message)) = first.split_once("): error ") {
        let line = place.rsplit('(').next().and_then(|line| line.split(',').next()?.parse().ok());
        let message = message.split_once(": ").map_or(message, |(_, message)| message);
        return Fault::new(advice(message)).at(line.and_then(|line| line_of(text, line)));
    }
    let title = first.split_once(": ").map_or(first, |(_, title)| title);
    let rest: Vec<&str> = lines.take_while(|line| !line.contains("error[")).collect();
    let place = rest.iter().find_map(|line| line.trim_start().strip_prefix("--> "));
    let line = place.and_then(|place| place.split(':').nth_back(1)?.parse().ok());
    let pointed = rest.iter().find_map(|line| line.trim_start().strip_prefix('|')?.trim().strip_prefix('^'));
    let message = pointed.map_or("", |message| message.trim_start_matches('^').trim());
    let message = if message.is_empty() { title } else { message };
    Fault::new(advice(message)).at(line.and_then(|line| line_of(text, line)))
}

/// The module of what the compiler made, with the user's own names.
fn module(wgsl: &str, function: &str) -> Result<Front, Fault> {
    let tokens = tokens(wgsl)?;
    let word = |at: usize| tokens.get(at).map_or("", |token| &wgsl[token.at.clone()]);
    let is_called = |&at: &usize| {
        tokens[at].function.is_some_and(|name| word(name) == ENTRY)
            && word(at + 1) == "("
            && stem(word(at)) == function
    };
    let Some(called) = (0..tokens.len()).find(is_called).map(word) else {
        return Err(Fault::new(format!("{COMPILER} leaves nothing of `{function}`")));
    };
    let mut bytes = wgsl.as_bytes().to_vec();
    let directives = directives(wgsl, &tokens);
    items::blank_others(&mut bytes, wgsl, &tokens, &directives, called, &BTreeSet::new());
    let reached = String::from_utf8_lossy(&bytes);
    let unread = |error: naga::front::wgsl::ParseError| {
        Fault::new(format!("what {COMPILER} makes of it is not read: {}", error.message()))
    };
    let mut module = naga::front::wgsl::parse_str(&reached).map_err(unread)?;
    validate(&module)?;
    rename(&mut module, called);
    Ok(Front { takes_copies: true, ..Front::plain(module, None) })
}

/// What stands before the number that the compiler puts behind a name.
fn stem(name: &str) -> &str {
    match name.rsplit_once('_') {
        Some((stem, number)) if !stem.is_empty() && number.bytes().all(|b| b.is_ascii_digit()) => stem,
        _ => name,
    }
}

/// Takes the numbers off names, where no two become the same; `called` gets its own name in any case.
fn rename(module: &mut Module, called: &str) {
    let counted = |names: &mut dyn Iterator<Item = Option<&str>>| {
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        names.flatten().for_each(|name| *counts.entry(stem(name).to_owned()).or_default() += 1);
        counts
    };
    let plain = |name: &mut Option<String>, counts: &BTreeMap<String, usize>| {
        if let Some(long) = name
            && counts.get(stem(long)) == Some(&1)
        {
            *long = stem(long).to_owned();
        }
    };
    let mut functions = counted(&mut module.functions.iter().map(|(_, function)| function.name.as_deref()));
    if let Some(count) = functions.get_mut(stem(called)).filter(|count| **count > 1) {
        *count = 0;
    }
    let globals = counted(&mut module.global_variables.iter().map(|(_, variable)| variable.name.as_deref()));
    for (_, function) in module.functions.iter_mut() {
        if function.name.as_deref() == Some(called) {
            function.name = Some(stem(called).to_owned());
        }
        plain(&mut function.name, &functions);
        let arguments = counted(&mut function.arguments.iter().map(|argument| argument.name.as_deref()));
        function.arguments.iter_mut().for_each(|argument| plain(&mut argument.name, &arguments));
    }
    module.global_variables.iter_mut().for_each(|(_, variable)| plain(&mut variable.name, &globals));
    let handles: Vec<_> = module.types.iter().map(|(handle, _)| handle).collect();
    for handle in handles {
        let mut ty = module.types[handle].clone();
        if let TypeInner::Struct { members, .. } = &mut ty.inner {
            let counts = counted(&mut members.iter().map(|member| member.name.as_deref()));
            members.iter_mut().for_each(|member| plain(&mut member.name, &counts));
            if module.types.get(&ty).is_none() {
                module.types.replace(handle, ty);
            }
        }
    }
}
