//! The threshold in the language of an engine: text or words to take away.
//!
//! Each export is a chunk without an entry point that declares the function `threshold`; paste it in front of the shader
//! that calls it. naga translates the WGSL of [`super::assemble`]; the name `threshold` and those of its parameters
//! survive in every language.

use super::assemble::{
    Coverage, FadeIn, InvalidOption, ScreenDoor, ShaderOptions, Source, Strata, Stratify, assemble,
};
use crate::threshold::hash::{UnknownName, by_name};
use crate::threshold::robust::Robust;
use crate::threshold::stage::stipple::Density;
use crate::threshold::two_scale::Variant;
use core::fmt;
use core::str::FromStr;
use naga::back::{glsl, hlsl, msl, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Block, EntryPoint, Function, Module, ShaderStage, Statement};

/// A shading language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
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
pub enum ExportError {
    /// An option has no meaning in any.
    #[error(transparent)]
    Option(#[from] InvalidOption),
    /// naga cannot write it.
    #[error("{language} cannot say this: {message}")]
    Language {
        /// The language.
        language: Language,
        /// What naga says.
        message: String,
    },
}

/// Returns the content of a file in `language` that declares the function `threshold`.
///
/// UTF-8 text that begins with comments on what it is and how it is called; little-endian words for SPIR-V. GLSL begins
/// with its `#version` line.
///
/// # Errors
///
/// [`ExportError`]: options without a meaning, or without one in this language.
pub fn export(options: &ShaderOptions, language: Language) -> Result<Vec<u8>, ExportError> {
    let wgsl = assemble(options)?;
    let fail = |message: String| ExportError::Language { language, message };
    if language == Language::Wgsl {
        return Ok(format!("{}\n{wgsl}", header(options, language)).into_bytes());
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
            return Ok(words.into_iter().flat_map(u32::to_le_bytes).collect());
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
    Ok(text.into_bytes())
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

/// How the exported file is put on trial; nothing where more follows the threshold.
fn on_trial(options: &ShaderOptions) -> Option<String> {
    let &ShaderOptions { variant, source, hash_scale, coverage: None, fade_in: None, stratify: None, .. } =
        options
    else {
        return None;
    };
    let mut asked = String::new();
    if variant != Variant::Isotropic {
        asked += &format!(" --variant {variant}");
    }
    match source {
        Source::Listing(_) => {}
        Source::Robust(join) => {
            asked += " --nested-phase";
            if join != Robust::new(variant).join {
                asked += &format!(" --join {join}");
            }
        }
        _ => return None,
    }
    if let Some(scale) = hash_scale.filter(|&scale| scale != 1.0) {
        asked += &format!(" --hash-scale {scale}");
    }
    Some(format!("Verify it: hashed-alpha check FILE{asked}"))
}

fn call(options: &ShaderOptions) -> String {
    let names: Vec<_> = options.parameters().iter().map(|parameter| parameter.name).collect();
    format!("threshold({})", names.join(", "))
}

/// The options in words, each with its place in the paper.
fn described(options: &ShaderOptions) -> Vec<String> {
    let mut parts = Vec::new();
    match options.source {
        Source::Listing(form) => {
            parts.push(match options.variant {
                Variant::Isotropic => "Listing 1".to_owned(),
                Variant::Anisotropic => "Listing 2".to_owned(),
                Variant::Linear => "linear scales (section 5.4.2)".to_owned(),
                Variant::Single => "a single scale (section 5.4.1)".to_owned(),
            });
            parts.push(format!("{form} form"));
        }
        Source::Robust(join) => {
            let listing = if options.variant == Variant::Anisotropic { 2 } else { 1 };
            parts.push(format!("Listing {listing} with every repair (not in the paper)"));
            parts.push(format!("join {join}"));
        }
        Source::Stochastic => parts.push("stochastic alpha testing (section 4)".to_owned()),
        Source::Fixed => parts.push("the traditional alpha test (section 1)".to_owned()),
        Source::Regular(samples) => parts.push(format!("the fixed dither of {samples} samples (Eq. 7)")),
        Source::ScreenDoor(ScreenDoor::Fixed) => parts.push("the ordered dither of 4 x 4 pixels".to_owned()),
        Source::ScreenDoor(ScreenDoor::RandomMask(seed)) => {
            parts.push(format!("a random mask of 4 x 4 pixels (section 3, seed {seed})"));
        }
        Source::PixelMask(samples) => {
            parts.push(format!("{samples} samples by a value of the pixel (Humus 2009)"));
        }
        Source::Stipple(density) => {
            let density = if density == Density::High { "high" } else { "low" };
            parts.push(format!("the traditional alpha test with a stipple of {density} density (Ols 2009)"));
        }
        Source::ScreenDoor(ScreenDoor::Randomised) => {
            parts.push("strata over tiles of 4 x 4 pixels (section 8.1)".to_owned());
        }
    }
    if matches!(options.source, Source::Listing(_) | Source::Robust(_)) {
        parts.push(format!("hash {}", options.hash));
        parts.extend(options.hash_scale.map(|scale| format!("noise of {scale} pixels")));
    }
    if let Some(Stratify { frames, order }) = options.stratify {
        parts.push(format!("stratified over {frames} frames, order {} (Eq. 6)", order.name()));
    }
    if let Some(Coverage { samples, strata }) = options.coverage {
        let equation = match strata {
            Strata::InOrder => "Eq. 8",
            Strata::Decorrelated => "Eqs. 8 and 9",
            Strata::Shuffled => "Eq. 8, shuffled",
        };
        parts.push(format!("jittered over {samples} samples ({equation})"));
    }
    if let Some(FadeIn { full_noise_lod, anisotropy }) = options.fade_in {
        let anisotropy = if anisotropy { ", with anisotropy (section 7.1.1)" } else { "" };
        parts.push(format!("faded in up to level {full_noise_lod} (Eqs. 4 and 5{anisotropy})"));
    }
    parts
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
        let options = ShaderOptions::robust(Variant::Anisotropic);
        for language in Language::ALL {
            let bytes = export(&options, language).unwrap();
            if language == Language::SpirV {
                assert_eq!(bytes[..4], 0x0723_0203_u32.to_le_bytes());
                continue;
            }
            let text = String::from_utf8(bytes).unwrap();
            assert!(
                text.contains("Listing 2 with every repair (not in the paper), join copula, hash mm4"),
                "{text}"
            );
            assert!(text.contains("below threshold(position, dpdx, dpdy)."), "{text}");
            assert!(!text.contains("main("), "{text}");
            let trial = "// Verify it: hashed-alpha check FILE --variant anisotropic --nested-phase\n";
            assert_eq!(text.contains(trial), language.is_taken_on_trial(), "{text}");
        }
    }
}
