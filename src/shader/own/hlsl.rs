//! HLSL, by way of glslang, whose SPIR-V naga reads.

use super::error::Fault;
use super::front::{Front, read_spir_v};
use super::glsl;
use super::isolated::isolated;
use super::options::Options;
use super::quoted;
use super::scan::{Token, tokens};
use core::ops::Range;
use std::ffi::OsString;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicU32, Ordering};

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
    let Some(parameters) = parameters(text, &tokens, &asked.function) else {
        let known = quoted::functions(text).join(", ");
        return Err(Fault::new(format!(
            "there is no function `{}`; --function NAME takes one of another name; functions are {known}",
            asked.function
        )));
    };
    let (mut prepared, defines) = glsl::reached(text, &tokens, asked)?;
    let declared: String =
        parameters.iter().enumerate().map(|(index, ty)| format!(" {ty} a{index} = ({ty})0;")).collect();
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

/// The types of the parameters of a function; nothing where there is no such function.
fn parameters<'t>(text: &'t str, tokens: &[Token], function: &str) -> Option<Vec<&'t str>> {
    const QUALIFIERS: [&str; 9] =
        ["in", "out", "inout", "const", "uniform", "precise", "nointerpolation", "linear", "centroid"];
    let word = |at: usize| tokens.get(at).map_or("", |token| &text[token.at.clone()]);
    // Of several the one that hands on to the others.
    let defined = |&(_, token): &(usize, &Token)| token.function.is_some_and(|name| word(name) == function);
    let within = || tokens.iter().enumerate().filter(defined);
    let hands_on = within().find(|&(at, _)| word(at) == function).or_else(|| within().next());
    let name = hands_on.and_then(|(_, token)| token.function)?;
    let end = (name..tokens.len()).find(|&at| word(at) == ")" && tokens[at].parentheses == 0)?;
    let inside: Vec<usize> = (name + 2..end).collect();
    let parts = inside.split(|&at| word(at) == "," && tokens[at].parentheses == 1);
    let ty = |part: &[usize]| part.iter().map(|&at| word(at)).find(|word| !QUALIFIERS.contains(word));
    Some(parts.filter_map(ty).filter(|ty| *ty != "void").collect())
}

/// A folder that is gone afterwards.
struct Folder(PathBuf);

impl Folder {
    fn new() -> std::io::Result<Self> {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("hashed-alpha-{}-{count}", std::process::id()));
        std::fs::create_dir(&path)?;
        Ok(Self(path))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // Nothing else could be done about what stays.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Compiles a prepared text to SPIR-V; `text` is what the user wrote.
fn compiled(prepared: &str, defines: &[(String, String)], text: &str) -> Result<Vec<u8>, Fault> {
    let io = |error: std::io::Error| {
        Fault::new(format!("the compiler of HLSL cannot be handed the text: {error}"))
    };
    let folder = Folder::new().map_err(io)?;
    let (source, module) = (folder.0.join("shader.hlsl"), folder.0.join("shader.spv"));
    std::fs::write(&source, prepared).map_err(io)?;
    // Optimised, everything would be inlined into the entry point.
    let output = Command::new(COMPILER)
        .args(["-D", "-V", "-Od", "-S", "frag", "-e", ENTRY, "-o"])
        .arg(&module)
        .args(defines.iter().map(|(name, value)| OsString::from(format!("-D{name}={value}"))))
        .arg(&source)
        .output()
        .map_err(|error| match error.kind() {
            ErrorKind::NotFound => Fault::new(format!(
                "HLSL is read by {COMPILER}, which is not in PATH: install Debian's glslang-tools or the Vulkan SDK, or hand \
                 over SPIR-V (.spv)"
            )),
            _ => Fault::new(format!("{COMPILER}: {error}")),
        })?;
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

/// The bytes of a line, counted from 1; nothing behind the last.
fn line_of(text: &str, line: usize) -> Option<Range<usize>> {
    let start = text.split_inclusive('\n').take(line.checked_sub(1)?).map(str::len).sum::<usize>();
    let length = text.get(start..)?.lines().next()?.len();
    Some(start..start + length)
}
