//! HLSL, by way of glslang, whose SPIR-V naga reads.

use super::compiler::{Folder, line_of, not_handed, run};
use super::error::Fault;
use super::front::{Front, read_spir_v};
use super::glsl;
use super::isolated::isolated;
use super::options::Options;
use super::quoted;
use super::scan::{Token, tokens};
use std::ffi::OsString;
use std::path::Path;

/// The program of glslang.
const COMPILER: &str = "glslangValidator";

/// The entry point that calls the function: a module without one comes out empty.
const ENTRY: &str = "hashed_alpha_entry";

/// Reads a text; functions that the one on trial does not come to are left out, and so are lines of `#include`.
///
/// # Errors
///
/// No such function, no compiler, and what the compiler says.
pub(super) fn read(text: &str, asked: &Options) -> Result<Front, Fault> {
    let tokens = tokens(text)?;
    let Head { parameters, .. } = head(text, &tokens, &asked.function)?;
    let (prepared, defines) = glsl::reached(text, &tokens, asked)?;
    let mut prepared = without_constant_uniforms(prepared)?;
    let declared: String = parameters
        .iter()
        .enumerate()
        .map(|(index, Parameter { ty, .. })| format!(" {ty} a{index} = ({ty})0;"))
        .collect();
    let handed: Vec<_> = (0..parameters.len()).map(|index| format!("a{index}")).collect();
    prepared.push_str(&format!(
        "\nfloat4 {ENTRY}() : SV_Target {{{declared} {}({}); return float4(0, 0, 0, 0); }}\n",
        asked.function,
        handed.join(", ")
    ));
    let bytes = compiled(&prepared, &defines, text)?;
    let front = isolated(move || read_spir_v(&bytes))?;
    let defined = defines.into_iter().map(|(name, _)| name).collect();
    Ok(Front { defined, ..front })
}

/// Takes the `const` off globals that are given no value here: they are uniforms, and the compiler makes zeros of them.
fn without_constant_uniforms(text: String) -> Result<String, Fault> {
    let tokens = tokens(&text)?;
    let word = |at: usize| tokens.get(at).map_or("", |token| &text[token.at.clone()]);
    let mut bytes = text.clone().into_bytes();
    for (at, token) in tokens.iter().enumerate() {
        let is_global = token.function.is_none() && token.braces == 0 && token.parentheses == 0;
        if is_global && word(at) == "const" {
            let rest = || (at..tokens.len()).take_while(|&at| !matches!(word(at), ";" | "{"));
            let is_static = at > 0 && word(at - 1) == "static" || word(at + 1) == "static";
            if !is_static && !rest().any(|at| word(at) == "=") {
                bytes[token.at.clone()].fill(b' ');
            }
        }
    }
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// What a function takes and returns.
pub(super) struct Head<'t> {
    pub parameters: Vec<Parameter<'t>>,
    pub result: &'t str,
}

pub(super) struct Parameter<'t> {
    pub ty: &'t str,
    /// Whether the function may write it for its caller.
    pub is_out: bool,
}

/// What a function of a text takes and returns.
///
/// # Errors
///
/// No such function.
pub(super) fn head<'t>(text: &'t str, tokens: &[Token], function: &str) -> Result<Head<'t>, Fault> {
    const QUALIFIERS: [&str; 10] = [
        "in",
        "out",
        "inout",
        "const",
        "uniform",
        "precise",
        "nointerpolation",
        "linear",
        "centroid",
        "no_diff",
    ];
    let word = |at: usize| tokens.get(at).map_or("", |token| &text[token.at.clone()]);
    // Of several the one that hands on to the others.
    let defined = |&(_, token): &(usize, &Token)| token.function.is_some_and(|name| word(name) == function);
    let within = || tokens.iter().enumerate().filter(defined);
    let hands_on = within().find(|&(at, _)| word(at) == function).or_else(|| within().next());
    let name = hands_on.and_then(|(_, token)| token.function);
    let end = |name: usize| (name..tokens.len()).find(|&at| word(at) == ")" && tokens[at].parentheses == 0);
    let Some((name, end)) = name.and_then(|name| Some((name, end(name)?))) else {
        let known = quoted::functions(text).join(", ");
        return Err(Fault::absent(format!(
            "there is no function `{function}`; --function NAME takes one of another name; functions are {known}"
        )));
    };
    let inside: Vec<usize> = (name + 2..end).collect();
    let parts = inside.split(|&at| word(at) == "," && tokens[at].parentheses == 1);
    let parameter = |part: &[usize]| {
        let words = || part.iter().map(|&at| word(at));
        let ty = words().find(|word| !QUALIFIERS.contains(word)).filter(|ty| *ty != "void")?;
        Some(Parameter { ty, is_out: words().any(|word| matches!(word, "out" | "inout")) })
    };
    let result = name.checked_sub(1).map_or("void", word);
    Ok(Head { parameters: parts.filter_map(parameter).collect(), result })
}

/// Compiles a prepared text to SPIR-V; `text` is what the user wrote.
fn compiled(prepared: &str, defines: &[(String, String)], text: &str) -> Result<Vec<u8>, Fault> {
    let io = |error| not_handed("HLSL", &error);
    let folder = Folder::new("HLSL")?;
    let (source, module) = (folder.file("shader.hlsl"), folder.file("shader.spv"));
    std::fs::write(&source, prepared).map_err(io)?;
    // Optimised, everything would be inlined into the entry point.
    let mut arguments: Vec<OsString> =
        ["-D", "-V", "-Od", "-S", "frag", "-e", ENTRY, "-o"].map(OsString::from).to_vec();
    arguments.push(module.clone().into());
    arguments.extend(defines.iter().map(|(name, value)| OsString::from(format!("-D{name}={value}"))));
    arguments.push(source.clone().into());
    let missing = format!(
        "HLSL is read by {COMPILER}, which is not in PATH: install Debian's glslang-tools or the Vulkan SDK, or hand \
         over SPIR-V (.spv)"
    );
    let output = run(COMPILER, arguments, &missing)?;
    if !output.status.success() {
        return Err(said(&String::from_utf8_lossy(&output.stdout), &source, text));
    }
    std::fs::read(&module).map_err(io)
}

/// The first error of a compiler at the user's line.
fn said(output: &str, source: &Path, text: &str) -> Fault {
    let file = format!("{}:", source.display());
    let error = output.lines().find_map(|line| line.strip_prefix("ERROR: "));
    let Some(error) = error else { return Fault::new(format!("{COMPILER} fails: {}", output.trim())) };
    let placed =
        error.strip_prefix(&file).or_else(|| error.strip_prefix("0:")).and_then(|rest| rest.split_once(':'));
    match placed.and_then(|(line, message)| Some((line.trim().parse::<usize>().ok()?, message.trim()))) {
        Some((line, message)) => Fault::new(message.to_owned()).at(line_of(text, line)),
        None => Fault::new(error.to_owned()),
    }
}
