//! A user's own shader: read, checked, and brought into the form that the interpreter and a device take.
//!
//! A WGSL file is parsed and validated alone, so that a message names the user's own line and column. GLSL may come as
//! engines write it, see the list in `glsl.rs`. SPIR-V is read so that what is exported can be read back. Of a module
//! only the function and what it calls is kept; uniforms and overrides that it reads get the values that the user gives.

mod derivative;
mod error;
mod feed;
mod glsl;
mod macros;
mod nesting;
mod reduce;
mod scan;
mod setting;
mod signature;

pub use error::{Place, ShaderError};
pub use setting::Value;
pub use signature::{Binding, Input};

use super::assemble::{SAMPLE_INDEX, ShaderOptions, assemble};
use core::ops::Range;
use error::Fault;
use naga::valid::{Capabilities, FunctionError, ModuleInfo, ValidationError, ValidationFlags, Validator};
use naga::{Block, Expression, Handle, Module, Span, Statement};
use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// The largest file that is read.
pub const LARGEST_FILE: u64 = 4 << 20;

/// The language of a shader file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Language {
    /// WGSL: `.wgsl`.
    Wgsl,
    /// GLSL of any version: `.glsl`, `.frag`, `.vert`, `.comp`, `.fs`, `.vs`.
    Glsl,
    /// SPIR-V: `.spv`.
    SpirV,
}

impl Language {
    /// Returns the language that the ending of a file name stands for.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "wgsl" => Some(Self::Wgsl),
            "glsl" | "frag" | "vert" | "comp" | "fs" | "vs" => Some(Self::Glsl),
            "spv" => Some(Self::SpirV),
            _ => None,
        }
    }
}

/// What is asked of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// Name of the function.
    pub function: String,
    /// Values by name, as written: parameters, uniforms and overrides.
    pub settings: BTreeMap<String, String>,
}

impl Default for Options {
    fn default() -> Self {
        Self { function: "threshold".to_owned(), settings: BTreeMap::new() }
    }
}

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
    /// Name of the file.
    pub file: String,
    /// The text as it was read; empty for SPIR-V.
    pub source: String,
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
    let language = Language::of(path).ok_or_else(|| {
        fail("the ending of the name is none of .wgsl, .glsl, .frag, .vert, .comp, .fs, .vs, .spv".to_owned())
    })?;
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
    let text_of = |bytes| {
        core::str::from_utf8(bytes)
            .map(|text| text.strip_prefix('\u{feff}').unwrap_or(text))
            .map_err(|error| Fault::new(format!("byte {} is not UTF-8", error.valid_up_to() + 1)))
    };
    let mut prelude = 0;
    let outcome = (|| {
        if bytes.iter().all(u8::is_ascii_whitespace) {
            return Err(Fault::new("the file is empty"));
        }
        let front = match language {
            Language::Wgsl => {
                text = text_of(bytes)?;
                read_wgsl(text, &options.function)
            }
            Language::Glsl => {
                text = text_of(bytes)?;
                read_glsl(text, options, &mut prelude)
            }
            Language::SpirV => {
                let bytes = bytes.to_vec();
                isolated(move || read_spir_v(&bytes))
            }
        }?;
        let options = options.clone();
        isolated(move || reduce::reduce(front, &options))
    })();
    match outcome {
        Ok(reduce::Reduced { module, info, function, bindings }) => Ok(OwnShader {
            module,
            info,
            function,
            bindings,
            file: file.to_owned(),
            source: text.to_owned(),
            prelude,
        }),
        Err(Fault { message, at }) => {
            let place = at.and_then(|at| place(text, prelude, at.start));
            Err(ShaderError { file: file.to_owned(), place, message })
        }
    }
}

/// Makes the verified threshold of `options` ready to run, as if it came from a file; a noise size and a sample index
/// that it asks for are 1 and 0.
///
/// # Errors
///
/// [`ShaderError`]: options without a meaning, or with a parameter that a fragment does not know (the lengths of the
/// texture coordinate's derivatives).
pub fn assembled(name: &str, options: &ShaderOptions) -> Result<OwnShader, ShaderError> {
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

/// The place of a byte that naga saw: nothing for what was put before the user's text, its end for what was put behind.
fn place(text: &str, prelude: usize, offset: usize) -> Option<Place> {
    let offset = offset.checked_sub(prelude).filter(|_| !text.is_empty())?;
    Some(Place::of(text, offset))
}

/// A module as its front end read it.
struct Front {
    module: Module,
    /// Names of variables that wait for a value.
    uniforms: Vec<String>,
    /// Names of variables with an initial value in the text.
    initialised: Vec<String>,
    /// Settings that were macros.
    defined: Vec<String>,
    has_derivatives: bool,
}

impl Front {
    fn plain(module: Module, has_derivatives: bool) -> Self {
        Self { module, uniforms: Vec::new(), initialised: Vec::new(), defined: Vec::new(), has_derivatives }
    }
}

/// Runs naga on a stack of its own, for a limited time: it descends as the text nests, and where it panics or does not
/// come to an end that is a message.
fn isolated<T: Send + 'static>(run: impl FnOnce() -> Result<T, Fault> + Send + 'static) -> Result<T, Fault> {
    const STACK: usize = 256 << 20;
    const PATIENCE: Duration = Duration::from_secs(60);
    let (send, outcome) = channel();
    let work = move || {
        // Nobody listens any more where the time is over.
        let _ = send.send(run());
    };
    std::thread::Builder::new()
        .stack_size(STACK)
        .spawn(work)
        .map_err(|error| Fault::new(format!("no thread to read it on: {error}")))?;
    outcome.recv_timeout(PATIENCE).unwrap_or_else(|error| {
        Err(Fault::new(match error {
            RecvTimeoutError::Disconnected => {
                "naga, which reads shaders here, gave up on it without a message".to_owned()
            }
            RecvTimeoutError::Timeout => {
                format!("naga, which reads shaders here, did not come to an end in {PATIENCE:?}")
            }
        }))
    })
}

fn read_wgsl(text: &str, function: &str) -> Result<Front, Fault> {
    let tokens = scan::tokens(text)?;
    let mut bytes = text.as_bytes().to_vec();
    blank_imports(&mut bytes, &tokens)?;
    let has_derivatives = derivative::replace(&mut bytes, &tokens, function)?;
    // Only ASCII was replaced, by ASCII.
    let mut prepared = String::from_utf8_lossy(&bytes).into_owned();
    if has_derivatives {
        prepared.push_str(derivative::WGSL);
    }
    isolated(move || {
        let module = naga::front::wgsl::parse_str(&prepared).map_err(|error| {
            let at = error.labels().next().and_then(|(span, _)| span.to_range());
            let labels =
                error.labels().filter(|(_, label)| !label.is_empty()).map(|(_, label)| label.to_owned());
            let notes = error.notes().map(str::to_owned);
            Fault::new(joined(error.message(), labels.chain(notes))).at(at)
        })?;
        validate(&module)?;
        Ok(Front::plain(module, has_derivatives))
    })
}

/// Blanks the lines by which an engine puts a WGSL file together, `#import` and `#define_import_path`; what they bring is
/// not here.
fn blank_imports(bytes: &mut [u8], tokens: &[scan::Token]) -> Result<(), Fault> {
    let word =
        |bytes: &[u8], at: usize| tokens.get(at).map_or(Vec::new(), |token| bytes[token.at.clone()].to_vec());
    for (index, token) in tokens.iter().enumerate() {
        if word(bytes, index) != b"#" {
            continue;
        }
        if !matches!(&word(bytes, index + 1)[..], b"import" | b"define_import_path") {
            let message = "WGSL has no directives; those of an engine are to be carried out before";
            return Err(Fault::new(message).at(Some(token.at.clone())));
        }
        let line = bytes[token.at.start..].iter().position(|&byte| byte == b'\n');
        let mut end = line.map_or(bytes.len(), |length| token.at.start + length);
        if bytes[token.at.start..end].contains(&b'{') {
            // A list may go over several lines.
            let close = bytes[token.at.start..].iter().position(|&byte| byte == b'}');
            end = end.max(close.map_or(bytes.len(), |length| token.at.start + length + 1));
        }
        bytes[token.at.start..end]
            .iter_mut()
            .filter(|byte| !byte.is_ascii_whitespace())
            .for_each(|byte| *byte = b' ');
    }
    Ok(())
}

fn read_glsl(text: &str, asked: &Options, prelude: &mut usize) -> Result<Front, Fault> {
    let prepared = glsl::prepare(text, &asked.function, &asked.settings)?;
    *prelude = prepared.prelude;
    // What was prepared has the user's bytes at the user's places; the prelude is not there yet.
    isolated(move || {
        let mut options = naga::front::glsl::Options::from(naga::ShaderStage::Fragment);
        options.defines.extend(prepared.defines.iter().cloned());
        let module =
            naga::front::glsl::Frontend::default().parse(&options, &prepared.text).map_err(|errors| {
                let first = errors.errors.first();
                let at = first.and_then(|error| error.meta.to_range());
                Fault::new(first.map_or("it is no GLSL".to_owned(), |error| error.kind.to_string())).at(at)
            })?;
        validate(&module)?;
        let glsl::Prepared { uniforms, initialised, has_derivatives, defines, .. } = prepared;
        let defined = defines.into_iter().map(|(name, _)| name).collect();
        Ok(Front { module, uniforms, initialised, defined, has_derivatives })
    })
}

fn read_spir_v(bytes: &[u8]) -> Result<Front, Fault> {
    let options = naga::front::spv::Options { strict_capabilities: false, ..Default::default() };
    let module =
        naga::front::spv::parse_u8_slice(bytes, &options).map_err(|error| Fault::new(error.to_string()))?;
    validate(&module)?;
    Ok(Front::plain(module, false))
}

fn validate(module: &Module) -> Result<ModuleInfo, Fault> {
    Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(module).map_err(|error| {
        if let Some(fault) = wrong_result(module, error.as_inner()) {
            return fault;
        }
        // The shortest is the innermost.
        let at = error.spans().filter_map(|(span, _)| span.to_range()).min_by_key(ExactSizeIterator::len);
        let mut causes = Vec::new();
        let mut cause = core::error::Error::source(error.as_inner());
        while let Some(next) = cause {
            causes.push(next.to_string());
            cause = next.source();
        }
        Fault::new(joined(&error.as_inner().to_string(), causes)).at(at)
    })
}

/// A value of a wrong type behind `return`: naga names the value by a number, and its place wherever it comes from.
fn wrong_result(module: &Module, error: &ValidationError) -> Option<Fault> {
    let ValidationError::Function { handle, name, source } = error else { return None };
    let FunctionError::InvalidReturnType { expression, expected_ty } = source else { return None };
    let declared = expected_ty.map_or("nothing".to_owned(), |ty| signature::described(module, ty));
    let at = return_of(&module.functions[*handle].body, *expression);
    Some(Fault::new(format!("`{name}` returns a value of another type than {declared}")).at(at))
}

/// Finds where a value is returned.
fn return_of(block: &Block, wanted: Option<Handle<Expression>>) -> Option<Range<usize>> {
    block.span_iter().find_map(|(statement, span)| match statement {
        Statement::Return { value } if *value == wanted => span.to_range(),
        Statement::Block(inner) => return_of(inner, wanted),
        Statement::If { accept, reject, .. } => {
            return_of(accept, wanted).or_else(|| return_of(reject, wanted))
        }
        Statement::Switch { cases, .. } => cases.iter().find_map(|case| return_of(&case.body, wanted)),
        Statement::Loop { body, continuing, .. } => {
            return_of(body, wanted).or_else(|| return_of(continuing, wanted))
        }
        _ => None,
    })
}

fn joined(message: &str, rest: impl IntoIterator<Item = String>) -> String {
    let mut parts = vec![message.to_owned()];
    parts.extend(rest.into_iter().filter(|part| part != message));
    parts.join(": ")
}
