//! The assembled WGSL: every combination is a sound module, holds nothing that was not asked for, and keeps its names
//! in every language.

use core::num::NonZeroU32;
use hashed_alpha::shader::assemble::{AssembleError, HashScale, ShaderOptions, assemble};
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::hashed::HashedAlpha;
use hashed_alpha::threshold::pipeline::{
    FadeIn, FrameStrata, Independence, IndependentBy, Pipeline, SamplePattern, SampleStrata, ScreenDoor,
    Source,
};
use hashed_alpha::threshold::robust::{Join, Robust};
use hashed_alpha::threshold::stage::order::Order;
use hashed_alpha::threshold::stage::stipple::Density;
use hashed_alpha::threshold::two_scale::Variant;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Expression, Function, Module, TypeInner};
use std::collections::BTreeSet;

fn size(n: u32) -> NonZeroU32 {
    NonZeroU32::new(n).unwrap()
}

/// Every source that is hashed, with a noise of 0.7 pixels.
fn hashed() -> impl Iterator<Item = Pipeline> {
    Variant::ALL.into_iter().flat_map(|variant| {
        let listings = CdfForm::ALL
            .map(|form| HashedAlpha { variant, form, hash_scale: 0.7, ..HashedAlpha::default() }.into());
        let joins = Join::ALL.map(|join| Robust { join, hash_scale: 0.7, ..Robust::new(variant) }.into());
        listings.into_iter().chain(joins)
    })
}

/// Every other source, patterns without a source among them.
fn unhashed() -> impl Iterator<Item = Pipeline> {
    [Source::Stochastic, Source::Fixed(0.5)]
        .into_iter()
        .chain([ScreenDoor::Fixed, ScreenDoor::RandomMask(5), ScreenDoor::Randomised].map(Source::ScreenDoor))
        .chain(Density::ALL.map(|density| Source::Stipple { density, kept: 0.5 }))
        .map(Pipeline::from)
        .chain([SamplePattern::Regular, SamplePattern::ByPixel].map(|pattern| sampled(4, pattern)))
}

fn sampled(samples: u32, pattern: SamplePattern) -> Pipeline {
    Pipeline { sample_strata: Some(SampleStrata { samples: size(samples), pattern }), ..Pipeline::default() }
}

/// Every source, variant, hash and way of giving the hash scale, without stages.
fn plain() -> impl Iterator<Item = ShaderOptions> {
    let every_hash = |pipeline: Pipeline| HashKind::ALL.into_iter().map(move |hash| pipeline.with_hash(hash));
    hashed().flat_map(every_hash).chain(unhashed()).flat_map(|pipeline| {
        [HashScale::Written, HashScale::Parameter].map(|hash_scale| ShaderOptions { pipeline, hash_scale })
    })
}

/// Every set of stages in both forms on every source.
fn with_stages() -> impl Iterator<Item = ShaderOptions> {
    let orders = Order::ALL.map(|order| Some(FrameStrata { frames: size(7), order }));
    let frame_strata: Vec<_> = orders.into_iter().chain([None]).collect();
    let patterns = [SamplePattern::Jittered, SamplePattern::Decorrelated, SamplePattern::Shuffled];
    let sample_strata: Vec<_> = patterns
        .into_iter()
        .map(|pattern| Some(SampleStrata { samples: size(6), pattern }))
        .chain([None])
        .collect();
    let fade_in = [None, Some(false), Some(true)]
        .map(|choice| choice.map(|anisotropy| FadeIn { anisotropy, ..FadeIn::default() }));
    hashed()
        .chain(unhashed())
        .flat_map(|source| CdfForm::ALL.map(|form| Pipeline { form, ..source }))
        .flat_map(move |source| {
            let (frame_strata, sample_strata) = (frame_strata.clone(), sample_strata.clone());
            frame_strata.into_iter().flat_map(move |frame_strata| {
                sample_strata.clone().into_iter().flat_map(move |sample_strata| {
                    fade_in.into_iter().map(move |fade_in| {
                        let sample_strata = source.sample_strata.or(sample_strata);
                        Pipeline { frame_strata, sample_strata, fade_in, ..source }.into()
                    })
                })
            })
        })
}

fn module_of(text: &str) -> Result<(Module, ModuleInfo), String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|error| error.emit_to_string(text))?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .map_err(|error| error.emit_to_string(text))?;
    Ok((module, info))
}

/// Every name that the text declares.
fn declared(module: &Module) -> BTreeSet<String> {
    let mut names: BTreeSet<String> = BTreeSet::new();
    names.extend(module.constants.iter().filter_map(|(_, constant)| constant.name.clone()));
    for (_, declared) in module.types.iter() {
        if let TypeInner::Struct { members, .. } = &declared.inner {
            names.extend(declared.name.clone());
            names.extend(members.iter().filter_map(|member| member.name.clone()));
        }
    }
    for (_, function) in module.functions.iter() {
        names.extend(function.name.clone());
        names.extend(function.arguments.iter().filter_map(|argument| argument.name.clone()));
        names.extend(function.local_variables.iter().filter_map(|(_, local)| local.name.clone()));
        names.extend(function.named_expressions.values().cloned());
    }
    names
}

/// The functions, constants and structs that nothing leads to from `threshold`.
fn left_over(text: &str, module: &Module) -> Vec<String> {
    let top = module
        .functions
        .iter()
        .filter_map(|(_, function)| function.name.as_deref())
        .chain(module.constants.iter().filter_map(|(_, constant)| constant.name.as_deref()))
        .chain(module.types.iter().filter_map(|(_, declared)| declared.name.as_deref()));
    let code: String = text.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
    let words: Vec<_> = code.split(|c: char| !(c.is_alphanumeric() || c == '_')).collect();
    top.filter(|&name| name != "threshold" && words.iter().filter(|&&word| word == name).count() < 2)
        .map(str::to_owned)
        .collect()
}

#[test]
fn every_combination_is_a_sound_module_holds_nothing_unused_and_keeps_its_names() {
    let mut written = BTreeSet::new();
    for options in plain().chain(with_stages()) {
        let text = assemble(options).unwrap();
        let (module, info) = module_of(&text).unwrap_or_else(|error| panic!("{options:?}\n{error}\n{text}"));
        assert_eq!(left_over(&text, &module), Vec::<String>::new(), "{options:?}\n{text}");
        let (_, threshold) = module
            .functions
            .iter()
            .find(|(_, function)| function.name.as_deref() == Some("threshold"))
            .unwrap();
        let wanted: Vec<_> = options.parameters().iter().map(|parameter| parameter.name).collect();
        let found: Vec<_> =
            threshold.arguments.iter().map(|argument| argument.name.as_deref().unwrap_or("")).collect();
        assert_eq!(found, wanted, "{options:?}");
        assert!(reads_every_argument(threshold), "{options:?}\n{text}");
        // The same names become the same ones again.
        if written.insert(declared(&module)) {
            assert_eq!(renamed(&module, &info), [], "{options:?}");
        }
    }
}

/// A parameter that is asked for is read: no stage is lost on the way.
fn reads_every_argument(function: &Function) -> bool {
    (0..function.arguments.len() as u32).all(|index| {
        function
            .expressions
            .iter()
            .any(|(_, expression)| matches!(expression, Expression::FunctionArgument(i) if *i == index))
    })
}

#[test]
fn a_function_that_nobody_calls_is_seen() {
    let mut text = assemble(Pipeline::default()).unwrap();
    text.push_str("fn superfluous() -> f32 { return 1.0; }\n");
    let (module, _) = module_of(&text).unwrap();
    assert_eq!(left_over(&text, &module), ["superfluous"]);
}

#[test]
fn what_is_not_asked_for_leaves_no_trace() {
    let plain = assemble(Pipeline::default()).unwrap();
    for word in ["sin(", "lod", "frame", "sample", "pixel:", "hash_scale: f32) -> f32 {\n    return robust"] {
        assert!(!plain.contains(word), "{word}");
    }
    // Every stage has words of its own: they are in the text with it, and in no other.
    let in_frames = |order| Pipeline {
        frame_strata: Some(FrameStrata { frames: size(7), order }),
        ..Pipeline::default()
    };
    let door = |door| Pipeline::from(Source::ScreenDoor(door));
    for (pipeline, words) in [
        (in_frames(Order::Ascending), &["fn stratified"][..]),
        (in_frames(Order::Alternating), &["fn alternating"]),
        (in_frames(Order::VanDerCorput), &["fn radical_rank"]),
        (in_frames(Order::VanDerCorputLiteral), &["fn radical_inverse", "fn van_der_corput_literal"]),
        (in_frames(Order::PhaseRotated), &["fn rotated(", "fn entered"]),
        (door(ScreenDoor::Fixed), &["fn ordered", "fn regular"]),
        (door(ScreenDoor::RandomMask(5)), &["fn random_mask", ", 5u)"]),
        (door(ScreenDoor::Randomised), &["fn randomised", "fn murmur_words"]),
        (sampled(4, SamplePattern::ByPixel), &["fn pixel_value", "fn turned"]),
        (Source::Stipple { density: Density::Low, kept: 0.5 }.into(), &["fn is_apart", "select(1.0, 0.5"]),
        (sampled(4, SamplePattern::Shuffled), &["fn shuffled", "fn pcg("]),
    ] {
        let text = assemble(pipeline).unwrap();
        assert!(words.iter().all(|word| text.contains(word) && !plain.contains(word)), "{text}");
    }
    assert!(!assemble(in_frames(Order::VanDerCorput)).unwrap().contains("fn alternating"));
    let listing = assemble(Pipeline::listing(Variant::Isotropic)).unwrap();
    for word in ["u32", "bitcast", "octave_word", "0.707", "select"] {
        assert!(!listing.contains(word), "{word}");
    }
    let fixed = assemble(Pipeline::from(Source::Fixed(0.5))).unwrap();
    assert!(fixed.ends_with("fn threshold() -> f32 {\n    return 0.5;\n}\n"), "{fixed}");
}

#[test]
fn pipelines_without_a_text_say_why() {
    for value in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let hashed = HashedAlpha { hash_scale: f64::from(value), ..HashedAlpha::default() };
        let error = assemble(Pipeline::from(hashed));
        assert!(matches!(error, Err(AssembleError::Number { what: "the hash scale", .. })), "{error:?}");
        let fade_in = Some(FadeIn { full_noise_lod: value, ..FadeIn::default() });
        let error = assemble(Pipeline { fade_in, ..Pipeline::default() });
        assert!(
            matches!(error, Err(AssembleError::Number { what: "the level of full noise", .. })),
            "{error:?}"
        );
    }
    let smallest = Robust { hash_scale: 1.0e-45, ..Robust::default() };
    assert!(module_of(&assemble(Pipeline::from(smallest)).unwrap()).is_ok());
    let independence = Independence { frames: size(8), by: IndependentBy::Offset };
    let authored = FadeIn { authored: 0.25, ..FadeIn::default() };
    for pipeline in [
        Source::Given.into(),
        Source::Fixed(0.25).into(),
        Source::Stipple { density: Density::High, kept: 0.25 }.into(),
        sampled(4, SamplePattern::Hardware),
        sampled(4, SamplePattern::Independent),
        Pipeline { independence: Some(independence), ..Pipeline::default() },
        Pipeline { fade_in: Some(authored), ..Pipeline::default() },
    ] {
        let error = assemble(pipeline);
        assert!(matches!(error, Err(AssembleError::NoText(_))), "{pipeline:?}: {error:?}");
    }
}

/// Names that naga had to change in a language: it adds `_` to what ends in a digit or means something there.
fn renamed(module: &Module, info: &ModuleInfo) -> Vec<(&'static str, String)> {
    let mut found = Vec::new();
    for (language, text) in
        [("hlsl", hlsl(module, info)), ("msl", msl(module, info)), ("glsl", glsl(module, info))]
    {
        let words: BTreeSet<_> = text.split(|c: char| !(c.is_alphanumeric() || c == '_')).collect();
        for name in declared(module) {
            if name.ends_with(|c: char| c.is_ascii_digit()) || words.contains(format!("{name}_").as_str()) {
                found.push((language, name));
            }
        }
    }
    found
}

fn hlsl(module: &Module, info: &ModuleInfo) -> String {
    let mut text = String::new();
    let options = naga::back::hlsl::Options::default();
    let pipeline = naga::back::hlsl::PipelineOptions::default();
    naga::back::hlsl::Writer::new(&mut text, &options, &pipeline).write(module, info, None).unwrap();
    text
}

fn msl(module: &Module, info: &ModuleInfo) -> String {
    let options = naga::back::msl::Options::default();
    naga::back::msl::write_string(module, info, &options, &naga::back::msl::PipelineOptions::default())
        .unwrap()
        .0
}

/// GLSL needs an entry point.
fn glsl(module: &Module, _: &ModuleInfo) -> String {
    let mut module = module.clone();
    module.entry_points.push(naga::EntryPoint {
        name: "main".to_owned(),
        stage: naga::ShaderStage::Compute,
        early_depth_test: None,
        workgroup_size: [1; 3],
        workgroup_size_overrides: None,
        function: Function::default(),
        mesh_info: None,
        task_payload: None,
        incoming_ray_payload: None,
    });
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module).unwrap();
    let options = naga::back::glsl::Options {
        version: naga::back::glsl::Version::Desktop(450),
        ..naga::back::glsl::Options::default()
    };
    let pipeline = naga::back::glsl::PipelineOptions {
        shader_stage: naga::ShaderStage::Compute,
        entry_point: "main".to_owned(),
        multiview: None,
    };
    let mut text = String::new();
    naga::back::glsl::Writer::new(
        &mut text,
        &module,
        &info,
        &options,
        &pipeline,
        naga::proc::BoundsCheckPolicies::default(),
    )
    .unwrap()
    .write()
    .unwrap();
    text
}

#[test]
fn a_name_that_means_something_elsewhere_is_seen() {
    for (text, language) in [
        ("fn lerp(x: f32) -> f32 { return x; } fn threshold(x: f32) -> f32 { return lerp(x); }", "hlsl"),
        ("fn fixed(x: f32) -> f32 { return x; } fn threshold(x: f32) -> f32 { return fixed(x); }", "glsl"),
        ("fn hash2(x: f32) -> f32 { return x; } fn threshold(x: f32) -> f32 { return hash2(x); }", "msl"),
    ] {
        let (module, info) = module_of(text).unwrap();
        assert!(renamed(&module, &info).iter().any(|(found, _)| *found == language), "{text}");
    }
}
