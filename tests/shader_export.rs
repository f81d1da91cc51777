//! The exports, in the hands of other people's compilers, and read back.
//!
//! Without `glslangValidator` and `spirv-val` the trials that need them are ignored and say so; with
//! `HASHED_ALPHA_REQUIRE=compilers` that is a failure.

use hashed_alpha::shader::assemble::{HashScale, ShaderOptions};
use hashed_alpha::shader::export::{Exported, Language, export};
use hashed_alpha::shader::own;
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::pipeline::{
    FadeIn, FrameStrata, Pipeline, SamplePattern, SampleStrata, ScreenDoor, Source,
};
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::stage::order::Order;
use hashed_alpha::threshold::stage::stipple::Density;
use hashed_alpha::threshold::two_scale::Variant;
use libtest_mimic::{Arguments, Failed, Trial};
use std::collections::BTreeMap;
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

fn main() {
    let arguments = Arguments::from_args();
    let mut trials = vec![Trial::test("every_export_is_read_back_with_its_parameters", read_back)];
    let glslang = in_path("glslangValidator");
    let spirv_val = in_path("spirv-val");
    for language in [Language::Glsl, Language::GlslEs, Language::Hlsl] {
        trials.push(with(
            &glslang,
            "glslangValidator",
            &format!("glslang_compiles_{language}"),
            move |tool| compiled_by_glslang(tool, language),
        ));
    }
    trials.push(with(&glslang, "glslangValidator", "glslang_refuses_a_broken_export", glslang_refuses));
    trials.push(with(&spirv_val, "spirv-val", "spirv_val_accepts_every_module", accepted_by_spirv_val));
    trials.push(with(&spirv_val, "spirv-val", "spirv_val_refuses_a_broken_module", spirv_val_refuses));
    libtest_mimic::run(&arguments, trials).exit();
}

fn in_path(name: &str) -> Option<PathBuf> {
    env::split_paths(&env::var_os("PATH")?).map(|folder| folder.join(name)).find(|path| path.is_file())
}

/// A trial that needs a program.
fn with(
    tool: &Option<PathBuf>,
    program: &str,
    name: &str,
    run: impl FnOnce(&Path) -> Result<(), Failed> + Send + 'static,
) -> Trial {
    let is_required =
        env::var("HASHED_ALPHA_REQUIRE").is_ok_and(|list| list.split(',').any(|item| item == "compilers"));
    match tool.clone() {
        Some(tool) => Trial::test(name, move || run(&tool)),
        None if is_required => {
            let message = format!("no {program} in PATH, and HASHED_ALPHA_REQUIRE asks for compilers");
            Trial::test(name, || Err(Failed::from(message)))
        }
        None => Trial::test(format!("{name} (no {program} in PATH)"), || Ok(())).with_ignored_flag(true),
    }
}

/// Every source and every effect, each hash and each way of giving the scale at least once.
fn options() -> Vec<ShaderOptions> {
    let size = |n| NonZeroU32::new(n).unwrap();
    let mut all = Vec::new();
    for variant in Variant::ALL {
        let listings = CdfForm::ALL.map(|form| {
            let listing = HashedAlpha { variant, form, ..HashedAlpha::default().with_hash(HashKind::Mm4) };
            Pipeline::from(listing)
        });
        let joins = Join::ALL.map(|join| Pipeline::from(Robust { join, ..Robust::new(variant) }));
        all.extend(
            listings
                .into_iter()
                .chain(joins)
                .map(|pipeline| ShaderOptions { pipeline, hash_scale: HashScale::Parameter }),
        );
    }
    let mut written = Vec::new();
    for hash in HashKind::ALL {
        written.push(Pipeline::listing(Variant::Isotropic).with_hash(hash));
        written.push(Pipeline::robust(Variant::Isotropic).with_hash(hash));
    }
    written.extend(
        [
            Source::Stochastic,
            Source::Fixed(0.5),
            Source::ScreenDoor(ScreenDoor::RandomMask(5)),
            Source::Stipple { density: Density::High, kept: 0.5 },
        ]
        .map(Pipeline::from),
    );
    let sampled = |n, pattern| Some(SampleStrata { samples: size(n), pattern });
    for pattern in [SamplePattern::Regular, SamplePattern::ByPixel] {
        written.push(Pipeline { sample_strata: sampled(4, pattern), ..Pipeline::default() });
    }
    for form in CdfForm::ALL {
        for source in [Pipeline::robust(Variant::Anisotropic), Pipeline::listing(Variant::Anisotropic)] {
            written.push(Pipeline {
                frame_strata: Some(FrameStrata { frames: size(8), order: Order::Alternating }),
                sample_strata: sampled(6, SamplePattern::Decorrelated),
                fade_in: Some(FadeIn { anisotropy: true, ..FadeIn::default() }),
                form,
                ..source
            });
        }
    }
    all.extend(written.into_iter().map(ShaderOptions::from));
    all
}

fn text(options: &ShaderOptions, language: Language) -> Result<String, Failed> {
    match export(*options, language)? {
        Exported::Text(text) => Ok(text),
        Exported::Words(_) => Err(format!("{language} is no text").into()),
    }
}

/// The parameters that no fragment has get a value.
fn own_options(options: &ShaderOptions) -> own::Options {
    let extra = ["sample_index", "texel_dx", "texel_dy"];
    let settings: BTreeMap<_, _> = options
        .parameters()
        .iter()
        .filter(|parameter| extra.contains(&parameter.name))
        .map(|parameter| (parameter.name.to_owned(), "3".to_owned()))
        .collect();
    own::Options { settings, ..own::Options::default() }
}

fn read_back() -> Result<(), Failed> {
    for options in options() {
        for (language, read) in [
            (Language::Wgsl, own::Language::Wgsl),
            (Language::Glsl, own::Language::Glsl),
            (Language::GlslEs, own::Language::Glsl),
            (Language::SpirV, own::Language::SpirV),
        ] {
            let bytes = export(options, language)?.into_bytes();
            let shader = own::parse(language.name(), read, &bytes, &own_options(&options))
                .map_err(|error| format!("{options:?}\n{error}\n{}", String::from_utf8_lossy(&bytes)))?;
            let names: Vec<_> = shader.bindings.iter().map(|binding| binding.name.as_str()).collect();
            let wanted: Vec<_> = options.parameters().iter().map(|parameter| parameter.name).collect();
            assert_eq!(names, wanted, "{language} {options:?}");
        }
    }
    Ok(())
}

/// A whole fragment shader around an exported chunk.
fn caller(options: &ShaderOptions, language: Language) -> Result<String, Failed> {
    let chunk = text(options, language)?;
    let arguments: Vec<_> = options
        .parameters()
        .iter()
        .map(|parameter| match (parameter.wgsl_type, language) {
            ("vec3<f32>", Language::Hlsl) => "float3(1.0, 2.0, 3.0)",
            ("vec2<f32>", Language::Hlsl) => "float2(1.0, 2.0)",
            ("vec3<f32>", _) => "vec3(1.0, 2.0, 3.0)",
            ("vec2<f32>", _) => "vec2(1.0, 2.0)",
            ("u32", _) => "3u",
            _ => "0.5",
        })
        .collect();
    let call = format!("threshold({})", arguments.join(", "));
    Ok(match language {
        Language::Hlsl => {
            format!("{chunk}\nfloat4 main() : SV_Target {{ return float4({call}, 0.0, 0.0, 0.0); }}\n")
        }
        _ => format!(
            "{chunk}\nlayout(location = 0) out vec4 color;\nvoid main() {{ color = vec4({call}); }}\n"
        ),
    })
}

fn glslang(tool: &Path, language: Language, text: &str) -> Result<(bool, String), Failed> {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("shader.frag");
    fs::write(&file, text)?;
    let mut command = Command::new(tool);
    if language == Language::Hlsl {
        command.args(["-D", "-V", "-e", "main", "-o"]).arg(folder.path().join("out.spv"));
    }
    let output = command.args(["-S", "frag"]).arg(&file).output()?;
    Ok((output.status.success(), String::from_utf8_lossy(&output.stdout).into_owned()))
}

fn compiled_by_glslang(tool: &Path, language: Language) -> Result<(), Failed> {
    for options in options() {
        let text = caller(&options, language)?;
        let (accepted, message) = glslang(tool, language, &text)?;
        if !accepted {
            return Err(format!("{options:?}\n{message}\n{text}").into());
        }
    }
    Ok(())
}

fn glslang_refuses(tool: &Path) -> Result<(), Failed> {
    let options = ShaderOptions::default();
    for language in [Language::Glsl, Language::GlslEs, Language::Hlsl] {
        let text = caller(&options, language)?.replace("float threshold(", "float other(");
        if glslang(tool, language, &text)?.0 {
            return Err(format!("{language} without the function was accepted").into());
        }
    }
    Ok(())
}

fn spirv_val(tool: &Path, bytes: &[u8]) -> Result<(bool, String), Failed> {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("shader.spv");
    fs::write(&file, bytes)?;
    let output = Command::new(tool).arg(&file).output()?;
    Ok((output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned()))
}

fn accepted_by_spirv_val(tool: &Path) -> Result<(), Failed> {
    for options in options() {
        let (accepted, message) = spirv_val(tool, &export(options, Language::SpirV)?.into_bytes())?;
        if !accepted {
            return Err(format!("{options:?}\n{message}").into());
        }
    }
    Ok(())
}

fn spirv_val_refuses(tool: &Path) -> Result<(), Failed> {
    let mut bytes = export(Pipeline::default(), Language::SpirV)?.into_bytes();
    bytes.truncate(bytes.len() / 8 * 4);
    if spirv_val(tool, &bytes)?.0 {
        return Err("half a module was accepted".into());
    }
    Ok(())
}
