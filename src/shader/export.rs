//! The threshold in the language of an engine: text or words to take away.
//!
//! Each export is a chunk without an entry point that declares the function `threshold`; paste it in front of the shader
//! that calls it. naga translates the WGSL of [`super::assemble`]; the name `threshold` and those of its parameters
//! survive in every language.

use super::assemble::{AssembleError, HashScale, ShaderOptions, assemble};
use crate::threshold::choice::{UnknownName, by_name};
use crate::threshold::hash::HashKind;
use crate::threshold::hashed::HashedAlpha;
use crate::threshold::model::Model;
use crate::threshold::pipeline::{
    FadeIn, FrameStrata, Pipeline, SamplePattern, SampleStrata, ScreenDoor, Source,
};
use crate::threshold::robust::Robust;
use crate::threshold::two_scale::Variant;
use core::fmt;
use core::str::FromStr;
use naga::back::{glsl, hlsl, msl, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Block, EntryPoint, Function, Module, ShaderStage, Statement};

/// A shading language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Language {
    /// WGSL.
    Wgsl,
    /// GLSL 4.50, for OpenGL and Vulkan.
    Glsl,
    /// GLSL ES 3.00, for OpenGL ES from 3.0 on and WebGL 2.
    GlslEs,
    /// HLSL, shader model 5.1.
    Hlsl,
    /// The Metal Shading Language.
    Msl,
    /// SPIR-V 1.1, a library module with names.
    SpirV,
}

impl Language {
    /// Every language, in the order in which they are listed to users.
    pub const ALL: [Self; 6] = [Self::Wgsl, Self::Glsl, Self::GlslEs, Self::Hlsl, Self::Msl, Self::SpirV];

    /// The name by which a user asks for it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Wgsl => "wgsl",
            Self::Glsl => "glsl",
            Self::GlslEs => "glsl-es",
            Self::Hlsl => "hlsl",
            Self::Msl => "msl",
            Self::SpirV => "spirv",
        }
    }

    /// Whether it has a text that a shader on trial may be written in.
    const fn is_taken_on_trial(self) -> bool {
        matches!(self, Self::Wgsl | Self::Glsl | Self::GlslEs)
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Language {
    type Err = UnknownName;
    fn from_str(name: &str) -> Result<Self, UnknownName> {
        by_name("shading language", &Self::ALL, Self::name, name)
    }
}

/// Options that cannot be said in a language.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// There is no text in any.
    #[error(transparent)]
    Pipeline(#[from] AssembleError),
    /// naga cannot write it.
    #[error("{language} cannot say this: {message}")]
    Language {
        /// The language.
        language: Language,
        /// What naga says.
        message: String,
    },
}

/// A shader file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Exported {
    /// Of the languages that are text.
    Text(String),
    /// Of SPIR-V: a module, word by word.
    Words(Vec<u32>),
}

impl Exported {
    /// Returns the content of the file: UTF-8, or little-endian words.
    #[must_use]
    pub fn into_bytes(self) -> Vec<u8> {
        match self {
            Self::Text(text) => text.into_bytes(),
            Self::Words(words) => words.into_iter().flat_map(u32::to_le_bytes).collect(),
        }
    }
}

/// Returns a file in `language` that declares the function `threshold`.
///
/// Text begins with comments on what it is and how it is called; GLSL begins with its `#version` line.
///
/// # Errors
///
/// [`ExportError`]: a pipeline without a text, or without one in this language.
pub fn export(options: impl Into<ShaderOptions>, language: Language) -> Result<Exported, ExportError> {
    let options = &options.into();
    let wgsl = assemble(*options)?;
    let fail = |message: String| ExportError::Language { language, message };
    if language == Language::Wgsl {
        return Ok(Exported::Text(format!("{}\n{wgsl}", header(options, language))));
    }
    let mut module = naga::front::wgsl::parse_str(&wgsl).map_err(|error| fail(error.to_string()))?;
    keep_parameter_names(&mut module, options);
    if matches!(language, Language::Glsl | Language::GlslEs) {
        module.entry_points.push(empty_entry_point());
    }
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .map_err(|error| fail(error.to_string()))?;
    let text = match language {
        Language::Wgsl | Language::SpirV => {
            let words = spir_v(&module, &info).map_err(|error| fail(error.to_string()))?;
            return Ok(Exported::Words(words));
        }
        Language::Glsl => to_glsl(&module, &info, glsl::Version::Desktop(450)).map_err(fail)?,
        Language::GlslEs => {
            let version = glsl::Version::Embedded { version: 300, is_webgl: false };
            to_glsl(&module, &info, version).map_err(fail)?
        }
        Language::Hlsl => to_hlsl(&module, &info).map_err(|error| fail(error.to_string()))?,
        Language::Msl => {
            let options = msl::Options { force_loop_bounding: false, ..msl::Options::default() };
            msl::write_string(&module, &info, &options, &msl::PipelineOptions::default())
                .map_err(|error| fail(error.to_string()))?
                .0
        }
    };
    let header = header(options, language);
    // A version line has to be the first.
    let text = match text.split_once('\n') {
        Some((version, rest)) if version.starts_with("#version") => format!("{version}\n{header}{rest}"),
        _ => format!("{header}\n{text}"),
    };
    Ok(Exported::Text(text))
}

/// naga writes each name once in a module and numbers the others; the names of the function that is called go first.
fn keep_parameter_names(module: &mut Module, options: &ShaderOptions) {
    let names = options.parameters();
    for (_, function) in module.functions.iter_mut() {
        if function.name.as_deref() == Some("threshold") {
            continue;
        }
        for name in function.arguments.iter_mut().filter_map(|argument| argument.name.as_mut()) {
            if names.iter().any(|parameter| parameter.name == name) {
                *name = format!("given_{name}");
            }
        }
    }
}

/// GLSL is written for an entry point.
fn empty_entry_point() -> EntryPoint {
    let body = Block::from_vec(vec![Statement::Return { value: None }]);
    EntryPoint {
        name: "main".to_owned(),
        stage: ShaderStage::Fragment,
        early_depth_test: None,
        workgroup_size: [0; 3],
        workgroup_size_overrides: None,
        function: Function { body, ..Function::default() },
        mesh_info: None,
        task_payload: None,
        incoming_ray_payload: None,
    }
}

fn to_glsl(module: &Module, info: &ModuleInfo, version: glsl::Version) -> Result<String, String> {
    let options = glsl::Options { version, ..glsl::Options::default() };
    let pipeline = glsl::PipelineOptions {
        shader_stage: ShaderStage::Fragment,
        entry_point: "main".to_owned(),
        multiview: None,
    };
    let policies = naga::proc::BoundsCheckPolicies::default();
    let mut text = String::new();
    glsl::Writer::new(&mut text, module, info, &options, &pipeline, policies)
        .and_then(|mut writer| writer.write())
        .map_err(|error| error.to_string())?;
    // Nothing follows the entry point, and nothing before it calls it.
    let end = text.rfind("void main()").ok_or("the entry point is not where it was")?;
    text.truncate(end);
    Ok(text)
}

fn to_hlsl(module: &Module, info: &ModuleInfo) -> Result<String, hlsl::Error> {
    let options = hlsl::Options { force_loop_bounding: false, ..hlsl::Options::default() };
    let mut text = String::new();
    hlsl::Writer::new(&mut text, &options, &hlsl::PipelineOptions::default()).write(module, info, None)?;
    Ok(text)
}

fn spir_v(module: &Module, info: &ModuleInfo) -> Result<Vec<u32>, spv::Error> {
    let options = spv::Options {
        lang_version: (1, 1),
        flags: spv::WriterFlags::DEBUG,
        force_loop_bounding: false,
        ..spv::Options::default()
    };
    spv::write_vec(module, info, &options, None)
}

/// What a reader of the file wants to know first.
fn header(options: &ShaderOptions, language: Language) -> String {
    let mut lines = vec![
        format!("hashed-alpha {}: {}", env!("CARGO_PKG_VERSION"), described(options).join(", ")),
        "After C. Wyman and M. McGuire, \"Improved Alpha Testing Using Hashed Sampling\" (2017).".to_owned(),
        format!("Discard a fragment where its alpha is below {}.", call(options)),
    ];
    let meanings = options.parameters();
    lines.extend(on_trial(options).filter(|_| language.is_taken_on_trial()));
    lines.extend(meanings.iter().map(|parameter| format!("  {}: {}", parameter.name, parameter.meaning)));
    if language != Language::Wgsl {
        lines.push("Written by naga out of WGSL.".to_owned());
    }
    lines.into_iter().map(|line| format!("// {line}\n")).collect()
}

/// The line of an exported file that says how it is tried, up to the options.
pub const VERIFY: &str = "Verify it: hashed-alpha check FILE";

/// How the exported file is put on trial; nothing where more follows the threshold.
fn on_trial(options: &ShaderOptions) -> Option<String> {
    let Pipeline {
        source: Source::Hash(model), sample_strata: None, fade_in: None, frame_strata: None, ..
    } = options.pipeline
    else {
        return None;
    };
    let mut asked = String::new();
    let (variant, hash_scale) = match model {
        Model::Hashed(HashedAlpha { variant, hash_scale, .. }) => (variant, hash_scale),
        Model::Robust(Robust { variant, hash_scale, .. }) => (variant, hash_scale),
        Model::BeforeCdf(_) => return None,
    };
    if variant != Variant::Isotropic {
        asked += &format!(" --variant {variant}");
    }
    if let Model::Robust(Robust { join, .. }) = model {
        asked += " --nested-phase";
        if join != Robust::new(variant).join {
            asked += &format!(" --join {join}");
        }
    }
    if options.hash_scale == HashScale::Written && hash_scale as f32 != 1.0 {
        asked += &format!(" --hash-scale {}", hash_scale as f32);
    }
    Some(format!("{VERIFY}{asked}"))
}

fn call(options: &ShaderOptions) -> String {
    let names: Vec<_> = options.parameters().iter().map(|parameter| parameter.name).collect();
    format!("threshold({})", names.join(", "))
}

/// The pipeline in words, each with its place in the paper.
fn described(options: &ShaderOptions) -> Vec<String> {
    let mut parts = Vec::new();
    let Pipeline { source, frame_strata, sample_strata, fade_in, .. } = options.pipeline;
    if options.pipeline.uses_source() {
        parts.extend(described_source(source, options.hash_scale));
    }
    if let Some(FrameStrata { frames, order }) = frame_strata {
        parts.push(format!("stratified over {frames} frames, order {} (Eq. 6)", order.name()));
    }
    if let Some(SampleStrata { samples, pattern }) = sample_strata {
        parts.push(match pattern {
            SamplePattern::Regular => format!("the fixed dither of {samples} samples (Eq. 7)"),
            SamplePattern::ByPixel => format!("{samples} samples by a value of the pixel (Humus 2009)"),
            SamplePattern::Jittered => format!("jittered over {samples} samples (Eq. 8)"),
            SamplePattern::Decorrelated => format!("jittered over {samples} samples (Eqs. 8 and 9)"),
            SamplePattern::Shuffled => format!("jittered over {samples} samples (Eq. 8, shuffled)"),
            // Of these there is no text.
            SamplePattern::Hardware | SamplePattern::Independent => pattern.name().to_owned(),
        });
    }
    if let Some(FadeIn { full_noise_lod, anisotropy, .. }) = fade_in {
        let anisotropy = if anisotropy { ", with anisotropy (section 7.1.1)" } else { "" };
        parts.push(format!("faded in up to level {full_noise_lod} (Eqs. 4 and 5{anisotropy})"));
    }
    parts
}

fn described_source(source: Source, scale: HashScale) -> Vec<String> {
    let hashed = |listing: [String; 2], hash: HashKind, hash_scale: f64| {
        let size = (scale == HashScale::Written).then(|| format!("noise of {} pixels", hash_scale as f32));
        listing.into_iter().chain([format!("hash {hash}")]).chain(size).collect()
    };
    vec![match source {
        Source::Hash(Model::Hashed(HashedAlpha { variant, hash, hash_scale, form })) => {
            let listing = match variant {
                Variant::Isotropic => "Listing 1",
                Variant::Anisotropic => "Listing 2",
                Variant::Linear => "linear scales (section 5.4.2)",
                Variant::Single => "a single scale (section 5.4.1)",
            };
            return hashed([listing.to_owned(), format!("{form} form")], hash, hash_scale);
        }
        Source::Hash(Model::Robust(Robust { variant, hash, hash_scale, join, .. })) => {
            let listing = if variant == Variant::Anisotropic { 2 } else { 1 };
            let repaired = format!("Listing {listing} with every repair (not in the paper)");
            return hashed([repaired, format!("join {join}")], hash, hash_scale);
        }
        Source::Stochastic => "stochastic alpha testing (section 4)".to_owned(),
        Source::Fixed(_) => "the traditional alpha test (section 1)".to_owned(),
        Source::ScreenDoor(ScreenDoor::Fixed) => "the ordered dither of 4 x 4 pixels".to_owned(),
        Source::ScreenDoor(ScreenDoor::Bayer) => {
            "the ordered dither of 8 x 8 pixels (Bayer 1973, not in the paper)".to_owned()
        }
        Source::ScreenDoor(ScreenDoor::RandomMask(seed)) => {
            format!("a random mask of 4 x 4 pixels (section 3, seed {seed})")
        }
        Source::ScreenDoor(ScreenDoor::Randomised) => {
            "strata over tiles of 4 x 4 pixels (section 8.1)".to_owned()
        }
        Source::Stipple { density, .. } => {
            let density = density.name();
            format!("the traditional alpha test with a stipple of {density} density (Ols 2009)")
        }
        // Of these there is no text.
        Source::Hash(Model::BeforeCdf(_)) | Source::Given => String::new(),
    }]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_back_to_their_language() {
        for language in Language::ALL {
            assert_eq!(language.name().parse(), Ok(language));
        }
        assert!("cg".parse::<Language>().is_err());
    }

    #[test]
    fn text_says_what_it_is_and_spir_v_has_its_magic_number() {
        for language in Language::ALL {
            let text = match export(Pipeline::robust(Variant::Anisotropic), language).unwrap() {
                Exported::Text(text) => text,
                Exported::Words(words) => {
                    assert_eq!((language, words[0]), (Language::SpirV, 0x0723_0203));
                    continue;
                }
            };
            assert!(
                text.contains(
                    "Listing 2 with every repair (not in the paper), join copula, hash lowbias-linear"
                ),
                "{text}"
            );
            assert!(text.contains("below threshold(position, dpdx, dpdy)."), "{text}");
            assert!(!text.contains("main("), "{text}");
            let trial = "// Verify it: hashed-alpha check FILE --variant anisotropic --nested-phase\n";
            assert_eq!(text.contains(trial), language.is_taken_on_trial(), "{text}");
        }
    }
}
