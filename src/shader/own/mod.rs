//! A user's own shader: read, checked, and brought into the form that the interpreter and a device take.
//!
//! A WGSL file is parsed and validated alone, so that a message names the user's own line and column. GLSL may come as
//! engines write it, see the list in `glsl/prepare.rs`. SPIR-V is read so that what is exported can be read back. Of a module
//! only the function and what it calls is kept; uniforms and overrides that it reads get the values that the user gives.

mod alpha_test;
mod arguments;
mod bisection;
mod blocks;
mod body;
mod comparisons;
mod compiler;
mod conditions;
mod definitions;
mod derivative;
mod directives;
mod error;
mod front;
mod glsl;
mod head;
mod hlsl;
mod includes;
mod invalid;
mod isolated;
mod items;
mod language;
mod mapping;
mod missing;
mod nesting;
mod options;
mod pointers;
mod quads;
mod quoted;
mod reduce;
mod rewriting;
mod scan;
mod sections;
mod setting;
mod signature;
mod slang;
mod sources;
mod statements;
mod unit;
mod usual;
mod variables;
mod waiting;
mod wgsl;
mod wrapping;

pub use error::{Place, ShaderError};
pub use isolated::READER;
pub use language::{Language, instead_of};
pub use mapping::Taken;
pub use options::{LARGEST_FILE, Options, THRESHOLD};
pub use scan::Token;
pub use setting::{Constant, Value};
pub use signature::{Binding, Input};

use super::assemble::{SAMPLE_INDEX, ShaderOptions, assemble};
use error::Fault;
use front::Front;
use head::Dialect;
use isolated::isolated;
use naga::valid::ModuleInfo;
use naga::{Module, Span};
use sources::Sources;
use std::collections::BTreeSet;
use std::io::Read;
use std::path::Path;
use unit::Unit;

/// A user's threshold, ready to run.
#[derive(Clone, Debug)]
pub struct OwnShader {
    /// The function and what it calls; without entry points, textures and buffers.
    pub module: Module,
    /// What naga knows of it.
    pub info: ModuleInfo,
    /// The name of the function in `module`.
    pub function: String,
    /// Its name in the file.
    pub named: String,
    /// Its parameters in order.
    pub bindings: Vec<Binding>,
    /// What was taken for a value of a fragment under another name than ours.
    pub taken: Vec<Taken>,
    /// What was done with the text before, in sentences: the test whose threshold is tried, the macros that are defined.
    pub notes: Vec<String>,
    /// Name of the file.
    pub file: String,
    /// Where the function is defined or first declared; nothing for SPIR-V.
    pub defined_at: Option<Place>,
    /// Where the bytes of the text come from; nothing for SPIR-V and HLSL, in which nothing of the module has a place.
    sources: Sources,
    /// Bytes that naga saw in front of the text.
    prelude: usize,
}

/// Reads a shader file. Files that it includes are looked for beside it and in [`Options::include`].
///
/// # Errors
///
/// [`ShaderError`]: the file cannot be read, is empty, or larger than [`LARGEST_FILE`]; and those of
/// [`parse`].
pub fn read(path: &Path, options: &Options) -> Result<OwnShader, ShaderError> {
    let file = path.display().to_string();
    let fail = |message: String| ShaderError { file: file.clone(), place: None, message, is_absent: false };
    let language = Language::of(path).unwrap_or(Language::Any);
    let mut bytes = Vec::new();
    // One byte more than is allowed tells a file that is too large, also where it has no length of its own.
    let opened = std::fs::File::open(path).map_err(|error| fail(error.to_string()))?;
    opened.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(|error| fail(error.to_string()))?;
    if bytes.len() as u64 > LARGEST_FILE {
        let size = std::fs::metadata(path).map_or(bytes.len() as u64, |metadata| metadata.len());
        return Err(fail(format!("the file has {size} bytes; at most {LARGEST_FILE} are read")));
    }
    let read = parse_in(path.parent(), &file, language, &bytes, options);
    read.map_err(|error| match language::around(path).filter(|_| !error.is_absent) {
        Some(advice) => ShaderError { message: format!("{} ({advice})", error.message), ..error },
        None => error,
    })
}

/// Reads a shader out of memory; `file` is its name in messages. Files that it includes are looked for in [`Options::include`] alone.
///
/// # Errors
///
/// [`ShaderError`]: text that is empty, not UTF-8 or not valid in its language; no function of that name, or one with
/// parameters that nothing gives a value to; something in it that needs a texture, a buffer or another pixel.
pub fn parse(
    file: &str,
    language: Language,
    bytes: &[u8],
    options: &Options,
) -> Result<OwnShader, ShaderError> {
    parse_in(None, file, language, bytes, options)
}

fn parse_in(
    folder: Option<&Path>,
    file: &str,
    language: Language,
    bytes: &[u8],
    options: &Options,
) -> Result<OwnShader, ShaderError> {
    let mut sources = Sources::default();
    let mut prelude = 0;
    let outcome = read_text(folder, file, language, bytes, options, &mut sources, &mut prelude);
    match outcome {
        Ok((reduced, named, notes)) => {
            let reduce::Reduced { module, info, function, bindings, taken, bisected } = reduced;
            let notes = notes.into_iter().chain(bisected).collect();
            let defined_at = definition(bytes, &named);
            Ok(OwnShader {
                module,
                info,
                function,
                named,
                bindings,
                taken,
                notes,
                file: file.to_owned(),
                defined_at,
                sources,
                prelude,
            })
        }
        Err(Fault { message, at, is_absent }) => {
            let found = at.and_then(|at| located(&sources, prelude, at.start));
            let (file, place) = found.map_or((file, None), |(file, place)| (file, Some(place)));
            Err(ShaderError { file: file.to_owned(), place, message, is_absent })
        }
    }
}

/// Reads bytes down to one function, with what was done on the way.
fn read_text(
    folder: Option<&Path>,
    file: &str,
    language: Language,
    bytes: &[u8],
    options: &Options,
    sources: &mut Sources,
    prelude: &mut usize,
) -> Result<(reduce::Reduced, String, Vec<String>), Fault> {
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(Fault::new("the file is empty"));
    }
    let reduced = |front: Front, options: &Options, pixels: BTreeSet<String>| {
        let options = options.clone();
        isolated(move || reduce::reduce(front, &options, &pixels))
    };
    if language == Language::SpirV {
        let owned = bytes.to_vec();
        let front = isolated(move || front::read_spir_v(&owned))?;
        return Ok((reduced(front, options, BTreeSet::new())?, options.function.clone(), Vec::new()));
    }
    let (sources_text, fault) = decoded(bytes);
    *sources = Sources::of(file, sources_text);
    fault?;
    let (asked, mut options) = (options, options.clone());
    let (text, written) = sections::uncovered(sources_text, &options.function);
    let text =
        if language == Language::Quoted { quoted::uncovered(&text, &mut options.function)? } else { text };
    // Which function is meant may have been told by the quotes that it stands between.
    let is_told = options.function != asked.function;
    let gaps = if language == Language::Quoted { quoted::gaps(sources_text, &text) } else { Vec::new() };
    let dialect = match language {
        Language::Wgsl => Dialect::Wgsl,
        Language::Hlsl | Language::Slang => Dialect::Hlsl,
        Language::Glsl | Language::SpirV => Dialect::Glsl,
        Language::Quoted | Language::Any => match written.or_else(|| Language::told_by(&text)) {
            Some(Language::Wgsl) => Dialect::Wgsl,
            Some(Language::Hlsl) => Dialect::Hlsl,
            Some(_) => Dialect::Glsl,
            None if language == Language::Quoted => Dialect::Glsl,
            None => return Err(Fault::new("no word of it is one of GLSL, HLSL or WGSL alone")),
        },
    };
    let unit = unit::unit(text, dialect, &options, folder, sources)?;
    let Unit { text, asked, named, mut notes, pixels } = unit;
    if is_told {
        notes.insert(0, unit::is_taken(&options.function));
    }
    if !gaps.is_empty() {
        let lines: Vec<_> = gaps.iter().map(ToString::to_string).collect();
        notes.push(format!(
            "what stands in `${{...}}` is left empty, in line {}: only the program knows it",
            lines.join(", ")
        ));
    }
    let read = match dialect {
        Dialect::Wgsl => wgsl::read(&text, &asked),
        Dialect::Glsl => glsl::read(&text, &asked, prelude),
        Dialect::Hlsl if language == Language::Slang => slang::read(&text, &asked, folder),
        Dialect::Hlsl => hlsl::read(&text, &asked),
    };
    let front = read.map_err(|fault| {
        let line = fault.at.as_ref().and_then(|at| sources.locate(at.start)).map(|(_, place)| place.line);
        let fault = conditions::with_branch(fault, &text);
        let is_unknown = fault.message.starts_with("Unknown") && !gaps.is_empty();
        let is_gap = is_unknown || line.is_some_and(|line| gaps.contains(&line));
        let more =
            if is_gap { " (what stands in `${...}` is left empty: only the program knows it)" } else { "" };
        Fault { message: fault.message + more, ..fault }
    })?;
    if dialect == Dialect::Hlsl {
        // What is found from here on has no place in it.
        *sources = Sources::default();
    }
    Ok((reduced(front, &asked, pixels)?, named, notes))
}

/// Makes the assembled threshold of `options` ready to run, as if it came from a file; a noise size and a sample index
/// that it asks for are 1 and 0.
///
/// # Errors
///
/// [`ShaderError`]: options without a meaning, or with a parameter that a fragment does not know (the lengths of the
/// texture coordinate's derivatives).
pub fn assembled(name: &str, options: impl Into<ShaderOptions>) -> Result<OwnShader, ShaderError> {
    let options = options.into();
    let text = assemble(options).map_err(|error| ShaderError {
        file: name.to_owned(),
        place: None,
        message: error.to_string(),
        is_absent: false,
    })?;
    let mut asked = Options::default();
    if options.parameters().contains(&SAMPLE_INDEX) {
        asked.settings.insert(SAMPLE_INDEX.name.to_owned(), "0".to_owned());
    }
    parse(name, Language::Wgsl, text.as_bytes(), &asked)
}

impl OwnShader {
    /// Returns the value of the parameter `hash_scale`; nothing where the function has no such parameter.
    #[must_use]
    pub fn hash_scale(&self) -> Option<f32> {
        self.bindings
            .iter()
            .filter(|binding| binding.name == "hash_scale")
            .find_map(|binding| binding.input.as_f32())
    }

    /// The same with the value of the parameter `hash_scale` so many times as large.
    #[must_use]
    pub fn rescaled(&self, times: f64) -> Self {
        let mut shader = self.clone();
        for binding in shader.bindings.iter_mut().filter(|binding| binding.name == "hash_scale") {
            if let Some(value) = binding.input.as_f32() {
                binding.input = Input::Constant(Value::F32((f64::from(value) * times) as f32).into());
            }
        }
        shader
    }

    /// Says that something is wrong with a part of the module.
    #[must_use]
    pub fn error_at(&self, span: Span, message: String) -> ShaderError {
        let found = span.to_range().and_then(|range| located(&self.sources, self.prelude, range.start));
        let (file, place) = found.map_or((self.file.as_str(), None), |(file, place)| (file, Some(place)));
        ShaderError { file: file.to_owned(), place, message, is_absent: false }
    }

    /// Returns where in the user's text, or in a file that it includes, a part of the module stands.
    #[must_use]
    pub fn place(&self, span: Span) -> Option<Place> {
        self.error_at(span, String::new()).place
    }
}

/// Cuts a text into words and signs; none where it cannot be cut, as where a comment does not end.
#[must_use]
pub fn words(text: &str) -> Vec<Token> {
    scan::tokens(text).unwrap_or_default()
}

/// The text of a file without its mark of order; where it is none, the part before the first wrong byte.
fn decoded(bytes: &[u8]) -> (&str, Result<(), Fault>) {
    let mut chunks = bytes.utf8_chunks();
    let first = chunks.next();
    let text = first.as_ref().map_or("", |chunk| chunk.valid());
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    match first.and_then(|chunk| chunk.invalid().first().copied()) {
        None => (text, Ok(())),
        Some(byte) => {
            let message = format!("the byte {byte:#04x} is not UTF-8");
            (text, Err(Fault::new(message).at(Some(text.len()..text.len() + 1))))
        }
    }
}

/// The place of the name of a function where it is defined or declared: behind another word, before a parenthesis.
fn definition(bytes: &[u8], function: &str) -> Option<Place> {
    let (text, Ok(())) = decoded(bytes) else { return None };
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let is_defined = |&(at, _): &(usize, &str)| {
        let (before, after) = (&text[..at], &text[at + function.len()..]);
        let space = before.trim_end();
        let word = space.rsplit(|c: char| !is_word(c)).next().unwrap_or_default();
        space.len() < before.len()
            && !matches!(word, "" | "return" | "else")
            && after.trim_start().starts_with('(')
    };
    text.match_indices(function).find(is_defined).map(|(at, _)| Place::of(text, at))
}

/// The file and the place of a byte that naga saw: nothing for what was put before the user's text, its end for what was put behind.
fn located(sources: &Sources, prelude: usize, offset: usize) -> Option<(&str, Place)> {
    sources.locate(offset.checked_sub(prelude)?)
}
