//! The assembled WGSL: every combination is a sound module, holds nothing that was not asked for, and keeps its names
//! in every language.

use core::num::NonZeroU16;
use hashed_alpha::shader::assemble::{
    Coverage, FadeIn, InvalidOption, ScreenDoor, ShaderOptions, Source, Strata, Stratify, assemble,
};
use hashed_alpha::threshold::cdf::CdfForm;
use hashed_alpha::threshold::hash::HashKind;
use hashed_alpha::threshold::robust::Join;
use hashed_alpha::threshold::stage::order::Order;
use hashed_alpha::threshold::stage::stipple::Density;
use hashed_alpha::threshold::two_scale::Variant;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Expression, Function, Module, TypeInner};
use std::collections::BTreeSet;

fn size(n: u16) -> NonZeroU16 {
    NonZeroU16::new(n).unwrap()
}

fn sources() -> impl Iterator<Item = Source> {
    CdfForm::ALL.map(Source::Listing).into_iter().chain(Join::ALL.map(Source::Robust)).chain([
        Source::Stochastic,
        Source::Fixed,
        Source::Regular(size(4)),
        Source::ScreenDoor(ScreenDoor::Fixed),
        Source::ScreenDoor(ScreenDoor::RandomMask(5)),
        Source::ScreenDoor(ScreenDoor::Randomised),
        Source::PixelMask(size(4)),
        Source::Stipple(Density::High),
        Source::Stipple(Density::Low),
    ])
}

/// Every source, variant, hash and way of giving the hash scale, without effects.
fn plain() -> impl Iterator<Item = ShaderOptions> {
    sources().flat_map(|source| {
        Variant::ALL.into_iter().flat_map(move |variant| {
            HashKind::ALL.into_iter().flat_map(move |hash| {
                [None, Some(0.7)].map(|hash_scale| ShaderOptions {
                    hash,
                    hash_scale,
                    source,
                    ..ShaderOptions::listing(variant)
                })
            })
        })
    })
}

/// Every set of effects on every source.
fn with_effects() -> impl Iterator<Item = ShaderOptions> {
    let orders = Order::ALL.map(|order| Some(Stratify { frames: size(7), order }));
    let stratify: Vec<_> = orders.into_iter().chain([None]).collect();
    let coverage = [None, Some(Strata::InOrder), Some(Strata::Decorrelated), Some(Strata::Shuffled)]
        .map(|choice| choice.map(|strata| Coverage { samples: size(6), strata }));
    let fade_in = [None, Some(false), Some(true)]
        .map(|choice| choice.map(|anisotropy| FadeIn { full_noise_lod: 6.0, anisotropy }));
    sources().flat_map(move |source| {
        stratify.clone().into_iter().flat_map(move |stratify| {
            coverage.into_iter().flat_map(move |coverage| {
                fade_in.into_iter().map(move |fade_in| ShaderOptions {
                    source,
                    stratify,
                    coverage,
                    fade_in,
                    ..ShaderOptions::robust(Variant::Isotropic)
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
fn every_combination_is_a_sound_module_and_holds_nothing_unused() {
    for options in plain().chain(with_effects()) {
        let text = assemble(&options).unwrap();
        let (module, _) = module_of(&text).unwrap_or_else(|error| panic!("{options:?}\n{error}\n{text}"));
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
    let mut text = assemble(&ShaderOptions::robust(Variant::Isotropic)).unwrap();
    text.push_str("fn superfluous() -> f32 { return 1.0; }\n");
    let (module, _) = module_of(&text).unwrap();
    assert_eq!(left_over(&text, &module), ["superfluous"]);
}

#[test]
fn what_is_not_asked_for_leaves_no_trace() {
    let plain = assemble(&ShaderOptions::robust(Variant::Isotropic)).unwrap();
    for word in ["sin(", "lod", "frame", "sample", "pixel:", "hash_scale: f32) -> f32 {\n    return robust"] {
        assert!(!plain.contains(word), "{word}");
    }
    // Every effect has words of its own: they are in the text with it, and in no other.
    let stratify = |order| ShaderOptions {
        stratify: Some(Stratify { frames: size(7), order }),
        ..ShaderOptions::robust(Variant::Isotropic)
    };
    let of = |source| ShaderOptions { source, ..ShaderOptions::robust(Variant::Isotropic) };
    let door = |door| of(Source::ScreenDoor(door));
    let coverage = Some(Coverage { samples: size(4), strata: Strata::Shuffled });
    let shuffled = ShaderOptions { coverage, ..ShaderOptions::robust(Variant::Isotropic) };
    for (options, words) in [
        (stratify(Order::Ascending), &["fn stratified"][..]),
        (stratify(Order::Alternating), &["fn alternating"]),
        (stratify(Order::VanDerCorput), &["fn radical_rank"]),
        (stratify(Order::VanDerCorputLiteral), &["fn radical_inverse", "fn van_der_corput"]),
        (stratify(Order::PhaseRotated), &["fn rotated(", "fn entered"]),
        (door(ScreenDoor::Fixed), &["fn ordered", "fn regular"]),
        (door(ScreenDoor::RandomMask(5)), &["fn random_mask", ", 5u)"]),
        (door(ScreenDoor::Randomised), &["fn randomised", "fn murmur_words"]),
        (of(Source::PixelMask(size(4))), &["fn pixel_value", "fn turned"]),
        (of(Source::Stipple(Density::Low)), &["fn is_apart", "select(1.0, 0.5"]),
        (shuffled, &["fn shuffled", "fn pcg("]),
    ] {
        let text = assemble(&options).unwrap();
        assert!(words.iter().all(|word| text.contains(word) && !plain.contains(word)), "{text}");
    }
    assert!(!assemble(&stratify(Order::VanDerCorput)).unwrap().contains("fn alternating"));
    let listing = assemble(&ShaderOptions::listing(Variant::Isotropic)).unwrap();
    for word in ["u32", "bitcast", "octave_word", "0.707", "select"] {
        assert!(!listing.contains(word), "{word}");
    }
    assert!(
        assemble(&ShaderOptions { source: Source::Fixed, ..ShaderOptions::listing(Variant::Single) })
            .unwrap()
            .ends_with("fn threshold() -> f32 {\n    return 0.5;\n}\n")
    );
}

#[test]
fn bad_options_are_named() {
    for value in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let options = ShaderOptions { hash_scale: Some(value), ..ShaderOptions::listing(Variant::Isotropic) };
        assert!(matches!(assemble(&options), Err(InvalidOption { what: "the hash scale", .. })));
        let fade_in = Some(FadeIn { full_noise_lod: value, anisotropy: false });
        let options = ShaderOptions { fade_in, ..ShaderOptions::listing(Variant::Isotropic) };
        assert!(matches!(assemble(&options), Err(InvalidOption { what: "the level of full noise", .. })));
    }
    let smallest = ShaderOptions { hash_scale: Some(1.0e-45), ..ShaderOptions::robust(Variant::Isotropic) };
    assert!(module_of(&assemble(&smallest).unwrap()).is_ok());
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
fn every_name_is_kept_in_every_language() {
    for options in plain().filter(|options| options.hash_scale.is_none()).chain(with_effects()) {
        let (module, info) = module_of(&assemble(&options).unwrap()).unwrap();
        assert_eq!(renamed(&module, &info), [], "{options:?}");
    }
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
