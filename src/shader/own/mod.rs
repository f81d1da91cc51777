//! A user's own shader: read, checked, and brought into the form that the interpreter and a device take.
//!
//! A WGSL file is parsed and validated alone, so that a message names the user's own line and column. GLSL may come as
//! engines write it, see the list in `glsl/prepare.rs`. SPIR-V is read so that what is exported can be read back. Of a module
//! only the function and what it calls is kept; uniforms and overrides that it reads get the values that the user gives.

mod arguments;
mod blocks;
mod body;
mod derivative;
mod error;
mod front;
mod glsl;
mod hlsl;
mod invalid;
mod isolated;
mod language;
mod mapping;
mod nesting;
mod options;
mod pointers;
mod quads;
mod quoted;
mod reduce;
mod scan;
mod setting;
mod signature;
mod variables;
mod wgsl;

pub use error::{Place, ShaderError};
pub use isolated::READER;
pub use language::{ENDINGS, Language, instead_of};
pub use mapping::Taken;
pub use options::Options;
pub use scan::Token;
pub use setting::{Constant, Value};
pub use signature::{Binding, Input};

use super::assemble::{SAMPLE_INDEX, ShaderOptions, assemble};
use error::Fault;
use isolated::isolated;
use naga::valid::ModuleInfo;
use naga::{Module, Span};
use std::io::Read;
use std::path::Path;

/// The largest file that is read.
pub const LARGEST_FILE: u64 = 4 << 20;

/// A user's threshold, ready to run.
#[derive(Clone, Debug)]
pub struct OwnShader {
    /// The function and what it calls; without entry points, textures and buffers.
    pub module: Module,
    /// What naga knows of it.
    pub info: ModuleInfo,
    /// The name of the function in `module`.
    pub function: String,
    /// Its parameters in order.
    pub bindings: Vec<Binding>,
    /// What was taken for a value of a fragment under another name than ours.
    pub taken: Vec<Taken>,
    /// Name of the file.
    pub file: String,
    /// The text as it was read; empty for SPIR-V and HLSL, in which nothing of the module has a place.
    pub source: String,
    /// Where the function is defined or first declared; nothing for SPIR-V.
    pub defined_at: Option<Place>,
    /// Bytes that naga saw in front of the text.
    prelude: usize,
}

/// Reads a shader file.
///
/// # Errors
///
/// [`ShaderError`]: the file cannot be read, is empty, larger than [`LARGEST_FILE`] or of an unknown kind; and those of
/// [`parse`].
pub fn read(path: &Path, options: &Options) -> Result<OwnShader, ShaderError> {
    let file = path.display().to_string();
    let fail = |message: String| ShaderError { file: file.clone(), place: None, message };
    let language =
        Language::of(path).ok_or_else(|| fail(format!("the ending of the name is none of {ENDINGS}")))?;
    let mut bytes = Vec::new();
    // One byte more than is allowed tells a file that is too large, also where it has no length of its own.
    let opened = std::fs::File::open(path).map_err(|error| fail(error.to_string()))?;
    opened.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(|error| fail(error.to_string()))?;
    if bytes.len() as u64 > LARGEST_FILE {
        let size = std::fs::metadata(path).map_or(bytes.len() as u64, |metadata| metadata.len());
        return Err(fail(format!("the file has {size} bytes; at most {LARGEST_FILE} are read")));
    }
    parse(&file, language, &bytes, options)
}

/// Reads a shader out of memory; `file` is its name in messages.
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
    let mut text = "";
    let mut prelude = 0;
    let outcome = (|| {
        if bytes.iter().all(u8::is_ascii_whitespace) {
            return Err(Fault::new("the file is empty"));
        }
        let front = match language {
            Language::Wgsl => {
                let decoded = decoded(bytes);
                text = decoded.0;
                decoded.1?;
                wgsl::read(text, options)
            }
            Language::Glsl => {
                let decoded = decoded(bytes);
                text = decoded.0;
                decoded.1?;
                glsl::read(text, options, &mut prelude)
            }
            Language::Hlsl => {
                let decoded = decoded(bytes);
                text = decoded.0;
                decoded.1?;
                let front = hlsl::read(text, options)?;
                // What is found from here on has no place in it.
                text = "";
                Ok(front)
            }
            Language::Quoted => {
                let decoded = decoded(bytes);
                text = decoded.0;
                decoded.1?;
                let uncovered = quoted::uncovered(text, &options.function)?;
                match quoted::defined(&uncovered, &options.function) {
                    Some("fn") => wgsl::read(&uncovered, options),
                    _ => glsl::read(&uncovered, options, &mut prelude),
                }
            }
            Language::SpirV => {
                let bytes = bytes.to_vec();
                isolated(move || front::read_spir_v(&bytes))
            }
        }?;
        let options = options.clone();
        isolated(move || reduce::reduce(front, &options))
    })();
    match outcome {
        Ok(reduce::Reduced { module, info, function, bindings, taken }) => Ok(OwnShader {
            module,
            info,
            function,
            bindings,
            taken,
            file: file.to_owned(),
            source: text.to_owned(),
            defined_at: definition(bytes, &options.function),
            prelude,
        }),
        Err(Fault { message, at }) => {
            let place = at.and_then(|at| place(text, prelude, at.start));
            Err(ShaderError { file: file.to_owned(), place, message })
        }
    }
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
        ShaderError { file: self.file.clone(), place: self.place(span), message }
    }

    /// Returns where in the user's text a part of the module stands.
    #[must_use]
    pub fn place(&self, span: Span) -> Option<Place> {
        span.to_range().and_then(|range| place(&self.source, self.prelude, range.start))
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

/// The place of a byte that naga saw: nothing for what was put before the user's text, its end for what was put behind.
fn place(text: &str, prelude: usize, offset: usize) -> Option<Place> {
    let offset = offset.checked_sub(prelude).filter(|_| !text.is_empty())?;
    Some(Place::of(text, offset))
}
