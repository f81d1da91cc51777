//! A user's own shader: what is taken, what is refused and with which words, and that nothing makes the reader panic.
#![cfg(feature = "shader")]

use hashed_alpha::scene::fragment::Fragment;
use hashed_alpha::shader::assemble::ShaderOptions;
use hashed_alpha::shader::export::{self, export};
use hashed_alpha::shader::interpreter::DeviceModel;
use hashed_alpha::shader::own::{
    Input, LARGEST_FILE, Language, Options, OwnShader, Place, Value, parse, read,
};
use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::two_scale::Variant;
use proptest::prelude::*;
use std::path::{Path, PathBuf};

fn examples() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/shaders");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

fn options(settings: &[(&str, &str)]) -> Options {
    let settings = settings.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    Options { settings, ..Options::default() }
}

/// The values that the examples ask for.
fn options_of(path: &Path) -> Options {
    match path.file_stem().and_then(|stem| stem.to_str()) {
        Some("listing_sine") if path.extension().is_some_and(|ending| ending == "glsl") => {
            options(&[("g_HashScale", "1")])
        }
        Some("mistake_case_selection") => options(&[("alpha_hash_scale", "1.0")]),
        _ => Options::default(),
    }
}

fn wgsl(text: &str, options: &Options) -> Result<OwnShader, String> {
    parse("own.wgsl", Language::Wgsl, text.as_bytes(), options).map_err(|error| error.to_string())
}

fn glsl(text: &str, options: &Options) -> Result<OwnShader, String> {
    parse("own.glsl", Language::Glsl, text.as_bytes(), options).map_err(|error| error.to_string())
}

#[test]
fn every_example_is_read_and_can_be_said_in_wgsl() {
    let examples = examples();
    assert_eq!(examples.len(), 10);
    for path in examples {
        let shader = read(&path, &options_of(&path)).unwrap_or_else(|error| panic!("{error}"));
        let text = shader.wgsl().unwrap();
        assert!(shader.call().starts_with("own_threshold("), "{}", shader.call());
        let caller = format!(
            "{text}\nfn word(k: u32) -> u32 {{ return k; }}\nfn number(k: u32) -> f32 {{ return f32(k); }}\n\
             fn caller() -> f32 {{ return {}; }}",
            shader.call()
        );
        let module = naga::front::wgsl::parse_str(&caller)
            .unwrap_or_else(|error| panic!("{}: {}", path.display(), error.emit_to_string(&caller)));
        assert!(module.entry_points.is_empty());
        assert!(shader.module.entry_points.is_empty());
    }
}

#[test]
fn parameters_are_found_by_name_in_any_order() {
    let text =
        "fn threshold(layer: u32, strength: i32, lod: f32, wide: bool, texcoord: vec2<f32>, hash_scale: f32,
                dpdy: vec3<f32>) -> f32 { return dpdy.x + lod * texcoord.x + f32(layer) + hash_scale; }";
    let shader = wgsl(text, &options(&[("strength", "-3"), ("wide", "true")])).unwrap();
    let inputs: Vec<_> = shader.bindings.iter().map(|binding| binding.input).collect();
    let constants = [Value::I32(-3), Value::Bool(true), Value::F32(1.0)].map(Input::Constant);
    assert_eq!(
        inputs,
        [Input::Layer, constants[0], Input::Lod, constants[1], Input::Texcoord, constants[2], Input::Dpdy]
    );
    let footprint =
        Footprint { position: glam::DVec3::ZERO, dpdx: glam::DVec3::ZERO, dpdy: glam::dvec3(1.0, 2.0, 3.0) };
    let fragment = Fragment { layer: 7, lod: 0.5, texcoord: glam::dvec2(8.0, 9.0), ..footprint.into() };
    let words = [7, 0.5_f32.to_bits(), 8.0_f32.to_bits(), 9.0_f32.to_bits(), 1.0_f32.to_bits()];
    assert_eq!(shader.words(&[fragment, fragment])[..5], words);
    assert_eq!(shader.words(&[fragment, fragment]).len(), 2 * shader.words_per_fragment());
    assert_eq!(
        shader.call(),
        "own_threshold(word(0u), i32(-3), number(1u), true, vec2<f32>(number(2u), number(3u)), 1.0f, \
         vec3<f32>(number(4u), number(5u), number(6u)), )"
    );
}

#[test]
fn what_is_refused_is_named_with_its_place() {
    let none = options(&[]);
    let mut wrong = Vec::new();
    for (text, wanted) in [
        ("", "own.wgsl: the file is empty"),
        (" \n\t", "own.wgsl: the file is empty"),
        ("fn threshold() -> f32 {\n    return 1.0 +;\n}", "own.wgsl:2:17: "),
        ("fn threshold() -> f32 {\n    return 1u;\n}", "own.wgsl:2:5: "),
        (
            "fn threshold(position: vec3<f32>) -> f32 {\n  if position.x > 0.0 { return 1.0; }\n  return position;\n}",
            "own.wgsl:3:3: `threshold` returns a value of another type than f32",
        ),
        (
            "fn other() -> f32 { return 1.0; }",
            "own.wgsl: there is no function `threshold`; functions are other; it",
        ),
        ("\n fn threshold() -> u32 { return 1u; }", "own.wgsl:2:2: `threshold` returns u32; it returns f32"),
        (
            "fn threshold(position: vec2<f32>) -> f32 { return 1.0; }",
            "parameter `position` of `threshold` is vec2<f32>",
        ),
        ("fn threshold(foo: f32) -> f32 { return foo; }", "--set foo=VALUE"),
        (
            "fn threshold(foo: vec4<f32>) -> f32 { return foo.x; }",
            "parameter `foo` of `threshold` is vec4<f32>; it",
        ),
        ("fn threshold(p: ptr<function, f32>) -> f32 { return *p; }", "a pointer"),
        (
            "@group(0) @binding(0) var t: texture_2d<f32>;
             fn threshold() -> f32 { return textureLoad(t, vec2(0, 0), 0).x; }",
            "own.wgsl:1:23: `t` is a texture, buffer",
        ),
        (
            "@group(0) @binding(0) var<uniform> foo: f32;\nfn threshold() -> f32 { return foo; }",
            "uniform `foo` has no value: --set foo=VALUE",
        ),
        (
            "override foo: f32;\nfn threshold() -> f32 { return foo; }",
            "override `foo` has no value: --set foo=VALUE",
        ),
        (
            "fn threshold(texcoord: vec2<f32>) -> f32 { return dpdx(texcoord.x); }",
            "own.wgsl:1:51: only the derivatives",
        ),
        (
            "fn other(position: vec3<f32>) -> f32 { return dpdx(position).x; }
             fn threshold(position: vec3<f32>) -> f32 { return other(position * 2.0); }",
            "own.wgsl:1:47: a derivative is known in the body of `threshold` only",
        ),
    ] {
        let error = wgsl(text, &none).expect_err(text);
        wrong.extend((!error.contains(wanted)).then(|| format!("{error}, not {wanted}")));
        assert!(!error.contains('\u{1b}'));
    }
    for (text, wanted) in [
        (
            "#version 300 es\nprecision highp float;\nfloat threshold() {\n  return 1.0 + ;\n}",
            "own.glsl:4:16: ",
        ),
        (
            "float threshold(vec3 position) {\n  float x = length(dFdx(position));\n  return x + y;\n}",
            "own.glsl:3:14: ",
        ),
        ("#version 330\nin vec3 v;\nfloat threshold() { return v.x; }", "`v` is filled before `main` starts"),
        (
            "float one() { return 1.0; }\nfloat bias = one();\nfloat threshold() { return bias; }",
            "`bias` is filled before `main` starts",
        ),
        (
            "uniform float foo;\nfloat threshold() { return foo; }",
            "uniform `foo` has no value: --set foo=VALUE",
        ),
        ("uniform vec3 foo;\nfloat threshold() { return foo.x; }", "uniform `foo` has no value"),
        ("float threshold(out float foo) { foo = 1.0; return 1.0; }", "a pointer (an `out` or `inout`)"),
        (
            "float threshold(float a) { return a; } float threshold(vec3 position) { return 1.0; }",
            "several functions",
        ),
        (
            "float threshold() { return dFdx(gl_FragCoord.x); }",
            "own.glsl:1:28: only the derivatives of `position`",
        ),
    ] {
        let error = glsl(text, &none).expect_err(text);
        wrong.extend((!error.contains(wanted)).then(|| format!("{error}, not {wanted}")));
    }
    assert_eq!(wrong, Vec::<String>::new());
    let no_text = parse("own.wgsl", Language::Wgsl, b"fn \xff", &none).unwrap_err();
    assert_eq!(no_text.to_string(), "own.wgsl: byte 4 is not UTF-8");
    let words = parse("own.spv", Language::SpirV, &[1, 2, 3], &none).unwrap_err();
    assert!(words.to_string().starts_with("own.spv: "), "{words}");
}

#[test]
fn settings_reach_uniforms_overrides_and_parameters_and_nothing_else() {
    let uniform = "@group(0) @binding(0) var<uniform> foo: f32;\nfn threshold() -> f32 { return foo; }";
    assert!(wgsl(uniform, &options(&[("foo", "0.25")])).unwrap().wgsl().unwrap().contains("0.25"));
    let constant = "override foo: u32 = 3;\n@id(7) override bar = foo * 2u;
                    fn threshold() -> f32 { return f32(foo + bar); }";
    assert!(wgsl(constant, &options(&[])).unwrap().wgsl().unwrap().contains("6u"));
    assert!(wgsl(constant, &options(&[("foo", "5")])).unwrap().wgsl().unwrap().contains("10u"));
    assert!(wgsl(constant, &options(&[("bar", "9")])).unwrap().wgsl().unwrap().contains("9u"));
    for (settings, wanted) in [
        (("foo", "-1"), "foo: `-1` is no u32"),
        (("foo", "1.5"), "foo: `1.5` is no u32"),
        (("fop", "1"), "nothing that `fop` could set"),
    ] {
        let error = wgsl(constant, &options(&[settings])).unwrap_err();
        assert!(error.contains(wanted), "{error}");
    }
    let error = wgsl(uniform, &options(&[("foo", "inf")])).unwrap_err();
    assert!(error.contains("`inf` is no f32"), "{error}");
    let other = Options { function: "mine".to_owned(), ..options(&[]) };
    assert!(wgsl("fn mine(position: vec3<f32>) -> f32 { return position.x; }", &other).is_ok());
}

#[test]
fn derivatives_of_the_position_come_with_the_fragment() {
    let text = "float threshold(vec3 position) { return length(dFdx(position)) + dFdy(position.xy).y + fwidth(position).z; }";
    let shader = glsl(text, &options(&[])).unwrap();
    let inputs: Vec<_> = shader.bindings.iter().map(|binding| binding.input).collect();
    assert_eq!(inputs, [Input::Position, Input::Dpdx, Input::Dpdy]);
    let own =
        "fn threshold(dpdy: vec3<f32>, position: vec3<f32>) -> f32 { return dpdxFine(position).x + dpdy.x; }";
    let shader = wgsl(own, &options(&[])).unwrap();
    let inputs: Vec<_> = shader.bindings.iter().map(|binding| binding.input).collect();
    assert_eq!(inputs, [Input::Dpdy, Input::Position, Input::Dpdx]);
}

#[test]
fn files_are_limited_and_known_by_their_ending() {
    let folder = tempfile::tempdir().unwrap();
    let large = folder.path().join("large.wgsl");
    std::fs::write(&large, vec![b'/'; LARGEST_FILE as usize + 3]).unwrap();
    let error = read(&large, &options(&[])).unwrap_err();
    assert!(error.message.contains("has 4194307 bytes; at most 4194304"), "{error}");
    let unknown = folder.path().join("shader.txt");
    assert!(read(&unknown, &options(&[])).unwrap_err().message.contains(".wgsl, .glsl"));
    assert!(read(&folder.path().join("absent.wgsl"), &options(&[])).is_err());
    let directory = folder.path().join("directory.wgsl");
    std::fs::create_dir(&directory).unwrap();
    assert!(read(&directory, &options(&[])).is_err());
}

#[test]
fn deep_nesting_is_a_message() {
    let deep =
        format!("fn threshold() -> f32 {{ return {}1.0{}; }}", "(".repeat(100_000), ")".repeat(100_000));
    assert!(wgsl(&deep, &options(&[])).unwrap_err().contains("nested too deeply"));
    let chain = format!("float threshold() {{ return {}1.0; }}", "- ".repeat(100_000));
    assert!(glsl(&chain, &options(&[])).unwrap_err().contains("nested too deeply"));
    let elses = "else if (x > 1.0) { x = 1.0; } ".repeat(900);
    let text = format!(
        "float threshold(float lod) {{ float x = lod; if (x < 0.0) {{ x = 0.0; }} {elses} return x; }}"
    );
    assert!(glsl(&text, &options(&[])).is_ok());
}

#[test]
fn what_would_take_a_parser_down_is_a_message() {
    let body =
        |expression: String| format!("fn threshold(position: vec3<f32>) -> f32 {{ return {expression}; }}");
    let glsl_body = |expression: String| format!("float threshold(vec3 position) {{ return {expression}; }}");
    let sum = "position.x + ".repeat(100_000) + "1.0";
    let swizzles = format!("position{}.x", ".xyz".repeat(100_000));
    for (text, wanted) in [(sum, "10000 operators"), (swizzles, "10000 operators")] {
        assert!(wgsl(&body(text.clone()), &options(&[])).unwrap_err().contains(wanted));
        assert!(glsl(&glsl_body(text), &options(&[])).unwrap_err().contains(wanted));
    }
    let indices = format!("position{}", "[0]".repeat(100_000));
    assert!(wgsl(&body(indices), &options(&[])).unwrap_err().contains("10000 operators"));
    let choices = "position.x > 0.5 ? 1.0 : ".repeat(30_000) + "0.5";
    assert!(glsl(&glsl_body(choices), &options(&[])).unwrap_err().contains("200 `&&`, `||` or `?`"));
    let bomb = "#define A0 1.0\n".to_owned()
        + &(1..40).map(|i| format!("#define A{i} A{0} + A{0}\n", i - 1)).collect::<String>()
        + &glsl_body("A39".to_owned());
    let error = glsl(&bomb, &options(&[])).unwrap_err();
    assert!(error.starts_with("own.glsl:41:41: more than"), "{error}");
    // What is within the limits is read, and said again, on whatever stack the caller has.
    let long = "position.x + ".repeat(4_900) + "1.0";
    assert!(wgsl(&body(long.clone()), &options(&[])).unwrap().wgsl().is_ok());
    assert!(glsl(&glsl_body(long), &options(&[])).is_ok());
    let calls = "fn g0(x: f32) -> f32 { return x; }".to_owned()
        + &(1..300)
            .map(|i| format!("fn g{i}(x: f32) -> f32 {{ return g{}(x); }}\n", i - 1))
            .collect::<String>()
        + &body("g299(position.x)".to_owned());
    let shader = wgsl(&calls, &options(&[])).unwrap();
    assert!(shader.program().unwrap_err().to_string().contains("nested more than 200 deep"));
}

#[test]
fn names_of_a_file_do_not_meet_those_around_it() {
    for name in
        ["word", "number", "element", "given_words", "made_words", "every_element", "own_threshold", "its_x"]
    {
        let text = format!(
            "struct S_{name} {{ {name}: f32 }}
             var<private> v_{name}: u32 = 3u;
             const c_{name} = vec2<f32>(1.0, 2.0);
             fn {name}(k: u32) -> f32 {{ return f32(k) * c_{name}.y; }}
             fn threshold(position: vec3<f32>) -> f32 {{
                 var s: S_{name};
                 s.{name} = {name}(v_{name});
                 return s.{name} + position.x;
             }}"
        );
        for text in [
            text.clone(),
            text.replace("v_", "")
                .replace(&format!("fn {name}("), "fn other(")
                .replace(&format!("{name}({name})"), &format!("other({name})")),
        ] {
            let shader = wgsl(&text, &options(&[])).unwrap_or_else(|error| panic!("{error}: {text}"));
            let written = shader.wgsl().unwrap();
            let declared = |keyword: &str| {
                let behind: Vec<_> = written.split(keyword).skip(1).collect();
                behind.into_iter().all(|rest| rest.starts_with("its_") || rest.starts_with("own_threshold("))
            };
            assert!(declared("fn ") && declared("struct ") && declared("var<private> "), "{written}");
            let fragment = Fragment::from(Footprint::<f64> {
                position: glam::dvec3(0.5, 0.0, 0.0),
                dpdx: glam::DVec3::ZERO,
                dpdy: glam::DVec3::ZERO,
            });
            let found = shader.thresholds(&shader.program().unwrap(), &[fragment], &DeviceModel::ACCURATE);
            assert_eq!(found.unwrap(), [6.5], "{text}");
        }
    }
}

#[test]
fn damaged_spir_v_gives_a_shader_or_a_message() {
    let whole = export(&ShaderOptions::robust(Variant::Isotropic), export::Language::SpirV).unwrap();
    let reads = |bytes: &[u8]| parse("own.spv", Language::SpirV, bytes, &options(&[])).is_ok();
    assert!(reads(&whole));
    for end in (0..whole.len()).step_by(whole.len() / 40) {
        assert!(!reads(&whole[..end]), "{end}");
    }
    // Counts and identifiers beyond everything.
    for word in (0..whole.len() / 4).step_by(whole.len() / 4 / 150) {
        for value in [u32::MAX, 0x7fff_ffff, 0] {
            let mut bytes = whole.clone();
            bytes[4 * word..][..4].copy_from_slice(&value.to_le_bytes());
            let _ = reads(&bytes);
        }
    }
}

#[test]
fn text_comes_as_editors_save_it() {
    let text = "// é\nfloat threshold(vec3 position) {\n    return fract(position.x);\n}\n";
    let wrong = text.replace("fract", "fractal");
    for (from, to) in [("\n", "\r\n"), ("\n", "\n\n"), ("", "")] {
        for mark in ["", "\u{feff}"] {
            let text_of =
                |text: &str| mark.to_owned() + &text.replace(from, if from.is_empty() { "" } else { to });
            assert!(glsl(&text_of(text), &options(&[])).is_ok(), "{:?}", text_of(text));
            let line = if to == "\n\n" { 5 } else { 3 };
            let error = glsl(&text_of(&wrong), &options(&[])).unwrap_err();
            assert!(error.starts_with(&format!("own.glsl:{line}:12: ")), "{error}");
        }
    }
    let wgsl_text = "\u{feff}fn threshold() -> f32 { return foo; }";
    assert!(wgsl(wgsl_text, &options(&[])).unwrap_err().starts_with("own.wgsl:1:32: "));
    for (text, wanted) in [
        ("#include <common>\nfloat threshold() { return 1.0; }", "own.glsl:1:1: files are not included"),
        ("float threshold() { return 1.0; }\n/* open", "own.glsl:2:1: a comment that does not end"),
        ("float threshold() { return \u{0}1.0; }", "own.glsl:1:28: \"\\0\" is no character of GLSL"),
        ("float threshold() { return größe; }", "own.glsl:1:30: \"ö\" is no character of GLSL"),
        ("float threshold() {", "own.glsl:1:20: "),
    ] {
        let error = glsl(text, &options(&[])).unwrap_err();
        assert!(error.starts_with(wanted), "{error}, not {wanted}");
    }
    let numbered = "@id(3) override foo: f32;\nfn threshold() -> f32 { return foo; }";
    assert!(
        wgsl(numbered, &options(&[])).unwrap_err().contains("override `foo` has no value: --set foo=VALUE")
    );
}

#[test]
fn settings_are_macros_where_conditions_ask_for_them() {
    let text = "#ifdef USE_HASH\nfloat threshold(vec3 position) { return STRENGTH * position.x; }\n#endif
#if !defined(STRENGTH)\n#define STRENGTH 0.5\n#endif";
    assert!(glsl(text, &options(&[])).unwrap_err().contains("functions are none"));
    let shader = glsl(
        &text.replace("#ifdef", "#if STRENGTH > 1\n#endif\n#ifdef"),
        &options(&[("USE_HASH", ""), ("STRENGTH", "2")]),
    );
    assert!(shader.unwrap().wgsl().unwrap().contains("2"));
}

#[test]
fn imports_of_an_engine_are_set_aside() {
    let text = "#define_import_path my::hash\n#import a::{\n  b,\n  c,\n}\n#import d\n
fn threshold(position: vec3<f32>) -> f32 { return fract(position.x); }";
    assert!(wgsl(text, &options(&[])).is_ok());
    let missing = text.replace("fract", "b");
    assert!(wgsl(&missing, &options(&[])).unwrap_err().starts_with("own.wgsl:8:51: "));
    let conditional = format!("#ifdef X\n{text}");
    assert!(
        wgsl(&conditional, &options(&[])).unwrap_err().starts_with("own.wgsl:1:1: WGSL has no directives")
    );
}

#[test]
fn a_main_may_do_what_only_older_versions_can() {
    let text = "#version 100
        varying vec3 v_position;
        uniform sampler2D u_map;
        float threshold(vec3 position) { return fract(position.x); }
        void main() {
            if (texture2D(u_map, v_position.xy).a < threshold(v_position)) { discard; }
            gl_FragColor = vec4(1.0);
        }";
    let shader = glsl(text, &options(&[])).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(shader.bindings.len(), 1);
}

#[test]
fn a_place_in_the_module_leads_back_to_the_text() {
    let text = "// comment\nfloat threshold(vec3 position) { return dFdx(position).x; }\n";
    let shader = glsl(text, &options(&[])).unwrap();
    let (_, function) = shader.module.functions.iter().next().unwrap();
    let places: Vec<_> = function
        .expressions
        .iter()
        .filter_map(|(at, _)| shader.place(function.expressions.get_span(at)))
        .collect();
    assert!(places.len() > 1 && places.iter().all(|place| place.line == 2), "{places:?}");
    // `screen_dx` stands where `dFdx` stood.
    assert!(places.contains(&Place { line: 2, column: 41 }), "{places:?}");
    assert_eq!(shader.place(naga::Span::UNDEFINED), None);
}

fn damaged() -> impl Strategy<Value = (usize, Vec<(usize, u8)>, Option<usize>)> {
    let bytes = proptest::collection::vec((0..5000_usize, any::<u8>()), 0..6);
    (0..10_usize, bytes, proptest::option::of(0..5000_usize))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Any damage to a shader gives a shader or a message.
    #[test]
    fn damaged_text_gives_a_shader_or_a_message((index, edits, end) in damaged()) {
        let path = &examples()[index];
        let mut bytes = std::fs::read(path).unwrap();
        for (at, byte) in edits {
            let length = bytes.len();
            bytes[at % length] = byte;
        }
        if let Some(end) = end {
            bytes.truncate(end);
        }
        let language = Language::of(path).unwrap();
        if let Err(error) = parse("damaged", language, &bytes, &options_of(path)) {
            prop_assert!(!error.message.is_empty());
            if let Some(Place { line, column }) = error.place {
                let lines: Vec<_> = bytes.split(|&byte| byte == b'\n').collect();
                prop_assert!((1..=lines.len()).contains(&line), "{error}");
                prop_assert!((1..=lines[line - 1].len() + 1).contains(&column), "{error}");
            }
        }
    }

    /// So does text that never was a shader.
    #[test]
    fn any_text_gives_a_message(text in "[-a-z0-9(){};=+*/.,<>#\n ]{0,60}") {
        for language in [Language::Wgsl, Language::Glsl, Language::SpirV] {
            prop_assert!(parse("any", language, text.as_bytes(), &options(&[])).is_err());
        }
    }
}
