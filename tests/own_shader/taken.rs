//! What is taken, and what becomes of it.

use super::*;

#[test]
fn every_example_is_read_and_can_be_said_in_wgsl() {
    let examples = examples();
    assert_eq!(examples.len(), 10);
    let page = include_str!("../../docs/your_shader.md");
    for path in examples {
        let name = path.file_name().unwrap().to_str().unwrap();
        assert!(page.contains(&format!("`{name}`")), "{name} is not in the documentation");
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
    let constants =
        [Value::I32(-3), Value::Bool(true), Value::F32(1.0)].map(|value| Input::Constant(value.into()));
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
fn a_hash_takes_a_cell_and_gives_32_bits() {
    let text = "fn threshold(v: vec4u) -> u32 { return v.x ^ (v.y << 8u) ^ (v.z << 16u) ^ (v.w << 24u); }";
    let shader = wgsl(text, &options(&[])).unwrap();
    assert!(shader.is_hash());
    assert_eq!(shader.bindings[0].input, Input::Cell);
    assert_eq!(shader.call(), "own_threshold(vec4<u32>(word(0u), word(1u), word(2u), word(3u)), )");
    // Four cells a unit: octave 2.
    let derivative = glam::dvec3(0.25, 0.0, 0.0);
    let position = glam::dvec3(0.3, 0.9, -0.1);
    let footprint = Footprint { position, dpdx: derivative, dpdy: glam::DVec3::ZERO };
    let fragments = [Fragment::from(footprint); 2];
    let cell = [1, 3, u32::MAX, 2];
    assert_eq!(shader.words(&fragments), [cell, cell].concat());
    let program = shader.program().unwrap();
    let hash = cell[0] ^ cell[1] << 8 ^ cell[2] << 16 ^ cell[3] << 24;
    let model = hashed_alpha::shader::interpreter::DeviceModel::ACCURATE;
    assert_eq!(shader.hashes(&program, &fragments, &model).unwrap(), [hash; 2]);
    assert!(shader.thresholds(&program, &fragments, &model).is_err());
    // A vector of another type is no cell.
    let error = wgsl("fn threshold(v: vec4i) -> u32 { return 1u; }", &options(&[])).unwrap_err().to_string();
    assert!(error.contains("returns u32") && error.contains("from one vec4<u32>"), "{error}");
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
        (("foo", "-1"), "`foo`: `-1` is no u32"),
        (("foo", "1.5"), "`foo`: `1.5` is no u32"),
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
fn settings_are_macros_where_conditions_ask_for_them() {
    let text = "#ifdef USE_HASH\nfloat threshold(vec3 position) { return STRENGTH * position.x; }\n#endif
#if !defined(STRENGTH)\n#define STRENGTH 0.5\n#endif";
    // What the function itself stands behind is defined without a word of the user's.
    let defined = glsl(&text.replace("STRENGTH * ", ""), &options(&[])).unwrap();
    assert_eq!(defined.notes, ["`USE_HASH` is defined as 1, since `threshold` stands behind it"]);
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
    let error = wgsl(&conditional, &options(&[])).unwrap_err();
    assert!(
        error.starts_with("own.wgsl:1:1: the file ends before this `#ifdef` has its `#endif`"),
        "{error}"
    );
    let shader = wgsl(&format!("{conditional}\n#endif"), &options(&[])).unwrap();
    assert_eq!(shader.notes, ["`X` is defined as 1, since `threshold` stands behind it"]);
    let directive = wgsl(&format!("#version 3\n{text}"), &options(&[])).unwrap_err();
    assert!(directive.starts_with("own.wgsl:1:1: WGSL has no directives"), "{directive}");
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
fn inputs_outputs_and_blocks_need_no_numbers() {
    let text = "#version 330
#line 7 \"chunk\"
layout(location = 3) uniform vec4 u_tint;
in vec3 vPos;
flat in vec2 vUv;
varying vec3 vNormal;
out vec4 first;
out vec4 second;
uniform Camera { mat4 view; vec3 eye; };
layout(std140) uniform Light { vec3 direction; } light;
layout(std140, binding = 2) uniform Fog { vec3 colour; } fog;
layout(std430) readonly buffer Table { float entries[]; } table;
layout(binding = 1) uniform sampler2D u_maps[4];
float threshold(vec3 position) { return fract(position.x); }
void main() { first = vec4(vPos, threshold(vPos)); second = texture(u_maps[0], vUv); }";
    let shader = glsl(text, &options(&[])).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(threshold(&shader, [1.25, 0.0, 0.0]), 0.25);
    let reads_block = text.replace("fract(position.x)", "fract(\n  eye.x)");
    let error = glsl(&reads_block, &options(&[])).unwrap_err();
    assert!(
        error.contains("`eye` of uniform block `Camera` has no value: --set Camera.eye=X,Y,Z"),
        "{error}"
    );
    let wrong = text.replace("fract(position.x)", "fract(positon.x)");
    assert!(glsl(&wrong, &options(&[])).unwrap_err().starts_with("own.glsl:14:47: `positon`"));
}

#[test]
fn only_what_the_threshold_comes_to_counts() {
    let text = "#version 100
varying vec3 v_position;
uniform sampler2D u_map;
float screen(vec3 p) { return length(dFdx(p * 2.0)); }
float masked(vec2 uv) { return texture2D(u_map, uv).a * screen(vec3(uv, 1.0)); }
float threshold(vec3 position) { return fract(position.x); }
void main() {
    if (masked(v_position.xy) < threshold(v_position)) { discard; }
}";
    let shader = glsl(text, &options(&[])).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(threshold(&shader, [1.25, 0.0, 0.0]), 0.25);
    let comes_to = text.replace("fract(position.x)", "screen(position)");
    assert_eq!(threshold(&glsl(&comes_to, &options(&[])).unwrap(), [1.25, 0.0, 0.0]), 0.25);
    let comes_to = text.replace("fract(position.x)", "masked(position.xy)");
    let error = glsl(&comes_to, &options(&[])).unwrap_err();
    assert!(error.starts_with("own.glsl:5:") && error.contains("`u_map` is a texture"), "{error}");

    let halves = "enable f16;\nfn other(x: f16) -> f16 { return x; }
fn threshold(position: vec3<f32>) -> f32 { return fract(position.x); }";
    assert!(wgsl(halves, &options(&[])).is_ok());

    let text = "fn screen(p: vec3<f32>) -> f32 { return length(dpdx(p * 2.0)); }
fn threshold(position: vec3<f32>) -> f32 { return fract(position.x); }
@fragment fn main(@location(0) p: vec3<f32>) -> @location(0) vec4<f32> {
    return vec4(screen(p), threshold(p), fwidth(p.xy));
}";
    let shader = wgsl(text, &options(&[])).unwrap();
    assert_eq!(threshold(&shader, [1.25, 0.0, 0.0]), 0.25);
    let comes_to = text.replace("fract(position.x)", "screen(position)");
    assert_eq!(threshold(&wgsl(&comes_to, &options(&[])).unwrap(), [1.25, 0.0, 0.0]), 0.25);
}

#[test]
fn vectors_are_set_by_their_components() {
    let uniform = "uniform vec3 k, j;\nfloat threshold(vec3 position) { return dot(position, k) + j.y; }";
    let set = [("k", "0.5, 0.25,2"), ("j", "0,8,0")];
    let shader = glsl(uniform, &options(&set)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(threshold(&shader, [1.0, 2.0, 4.0]), 17.0);
    let own = "@group(0) @binding(0) var<uniform> k: vec2<i32>;
fn threshold(position: vec3<f32>, j: vec4<u32>, wide: vec2<bool>) -> f32 {
    return select(0.0, f32(k.y), wide.y) + f32(j.w);
}";
    let set = [("k", "1,-2"), ("j", "1,2,3,4"), ("wide", "false,true")];
    let shader = wgsl(own, &options(&set)).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(threshold(&shader, [0.0; 3]), 2.0);
    assert!(
        shader.call().contains("vec4<u32>(1u, 2u, 3u, 4u), vec2<bool>(false, true)"),
        "{}",
        shader.call()
    );
    for (value, wanted) in [
        ("1,2", "own.glsl:1:14: `k` is vec3<f32> and takes 3 values, --set k=X,Y,Z, not 2"),
        ("1", "takes 3 values, --set k=X,Y,Z, not 1"),
        ("1,2,3,4", "not 4"),
        ("1,,3", "own.glsl:1:14: `k`: `` is no f32"),
        ("1,2,abc", "`k`: `abc` is no f32"),
    ] {
        let error = glsl(uniform, &options(&[("k", value), ("j", "0,0,0")])).unwrap_err();
        assert!(error.contains(wanted), "{error}, not {wanted}");
    }
    let scalar = "uniform float k;\nfloat threshold() { return k; }";
    assert!(glsl(scalar, &options(&[("k", "1,2")])).unwrap_err().contains("`k`: `1,2` is no f32"));
}

#[test]
fn members_of_blocks_are_set_by_name() {
    let text = "#version 330
layout(std140) uniform PerObject { mat4 world; float hashScale; vec2 offset; } u;
uniform Camera { vec3 eye; };
float threshold(vec3 position) { return u.hashScale * position.x + u.offset.y + eye.z; }";
    for [scale, eye] in [["u.hashScale", "Camera.eye"], ["hashScale", "eye"]] {
        let set = options(&[(scale, "0.5"), ("u.offset", "0,2"), (eye, "0,0,4")]);
        let shader = glsl(text, &set).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(threshold(&shader, [2.0, 0.0, 0.0]), 7.0);
        assert!(shader.wgsl().is_ok());
    }
    let error = glsl(text, &options(&[("hashScale", "1"), ("eye", "0,0,0")])).unwrap_err();
    assert!(error.contains("`offset` of uniform block `u` has no value: --set u.offset=X,Y"), "{error}");
    let error = glsl(text, &options(&[("hashScale", "1,2")])).unwrap_err();
    assert!(error.contains("`1,2` is no f32"), "{error}");

    let own = "struct Material { tint: vec4<f32>, scale: f32 }
@group(0) @binding(0) var<uniform> material: Material;
fn scaled(material: Material, x: f32) -> f32 { return material.scale * x; }
fn threshold(position: vec3<f32>) -> f32 { return scaled(material, position.x); }";
    let error = wgsl(own, &options(&[("scale", "0.5")])).unwrap_err();
    assert!(error.contains("`tint` of uniform block `material` has no value"), "{error}");
    let shader = wgsl(own, &options(&[("scale", "0.5"), ("material.tint", "1,1,1,1")])).unwrap();
    assert_eq!(threshold(&shader, [2.0, 0.0, 0.0]), 1.0);
}

#[test]
fn what_a_condition_leaves_out_may_be_anything() {
    let text = "#if 0
#error \"no\"
#error don't
#define S \"str\"
#include \"common.glsl\"
float größe @ $
#endif
float threshold(vec3 position) { return fract(position.x); }
#if 0
'
#endif";
    let shader = glsl(text, &options(&[])).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(threshold(&shader, [1.25, 0.0, 0.0]), 0.25);
    for (line, column) in [(2, 2), (4, 11), (6, 9)] {
        let lines = text.lines().enumerate();
        let kept: Vec<_> = lines
            .map(|(index, at)| {
                if index == 0 {
                    "#if 1"
                } else if index + 1 == line || index > 5 {
                    at
                } else {
                    ""
                }
            })
            .collect();
        let error = glsl(&kept.join("\n"), &options(&[])).unwrap_err();
        assert!(error.starts_with(&format!("own.glsl:{line}:{column}: ")), "{error}");
    }
}

#[test]
fn halves_may_be_packed_into_a_word() {
    let text =
        "float threshold(vec3 position) { return unpackHalf2x16(packHalf2x16(fract(position.xy))).x; }";
    let shader = glsl(text, &options(&[])).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(threshold(&shader, [1.25, 0.0, 0.0]), 0.25);
}

/// What glslang makes of `float threshold(vec3 position, vec3 dpdx)`: a mangled name, and pointers.
#[test]
fn spir_v_of_another_compiler_is_taken() {
    let text = "fn threshold(position: ptr<function, vec3<f32>>, dpdx: ptr<function, vec3<f32>>) -> f32 {
    *position = *position * 0.5;
    return (*position).x + (*dpdx).x;
}";
    let mut module = naga::front::wgsl::parse_str(text).unwrap();
    for (_, function) in module.functions.iter_mut() {
        function.name = Some("threshold(vf3;vf3;".to_owned());
    }
    let capabilities = naga::valid::Capabilities::all();
    let mut validator = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), capabilities);
    let info = validator.validate(&module).unwrap();
    let flags = naga::back::spv::WriterFlags::DEBUG;
    let written = naga::back::spv::Options { flags, ..Default::default() };
    let words = naga::back::spv::write_vec(&module, &info, &written, None).unwrap();
    let bytes: Vec<u8> = words.into_iter().flat_map(u32::to_le_bytes).collect();
    let shader =
        parse("own.spv", Language::SpirV, &bytes, &options(&[])).unwrap_or_else(|error| panic!("{error}"));
    let inputs: Vec<_> = shader.bindings.iter().map(|binding| binding.input).collect();
    assert_eq!(inputs, [Input::Position, Input::Dpdx]);
    assert_eq!(threshold(&shader, [2.0, 0.0, 0.0]), 1.125);
}

/// What became of the names of a shader.
fn taken(shader: &OwnShader) -> Vec<String> {
    shader.taken.iter().map(ToString::to_string).collect()
}

#[test]
fn the_usual_names_of_the_values_of_a_fragment_are_known() {
    for (text, names) in [
        ("float threshold(vec3 pos) { return fract(pos.x); }", "pos position"),
        (
            "float threshold(vec3 P, float hashScale) { return fract(P.x) * hashScale; }",
            "P position, hashScale hash_scale",
        ),
        ("in vec3 vPos;\nfloat threshold() { return fract(vPos.x); }", "vPos position"),
        (
            "varying vec3 v_position;
             float g() { return v_position.x; }
             float threshold() { return fract(g()); }",
            "v_position position",
        ),
        ("float threshold(vec4 worldPos) { return fract(worldPos.x) * worldPos.w; }", "worldPos position"),
        (
            "uniform int u_frame;
             float threshold(vec3 position) { return fract(position.x) + 0.0 * float(u_frame); }",
            "u_frame frame",
        ),
        (
            "float threshold(vec3 position) { return fract(position.x) + 0.0 * gl_FragCoord.w; }",
            "gl_FragCoord pixel",
        ),
        ("float threshold(vec3 p_0) { return fract(p_0.x + length(dFdx(p_0)) - 0.125); }", "p_0 position"),
    ] {
        let shader = glsl(text, &options(&[])).unwrap_or_else(|error| panic!("{error}"));
        let wanted = names.split(", ").map(|pair| pair.split_once(' ').unwrap());
        let wanted: Vec<_> = wanted.map(|(name, value)| format!("`{name}` is taken for `{value}`")).collect();
        assert_eq!(taken(&shader), wanted, "{text}");
        assert_eq!(threshold(&shader, [0.375, 0.0, 0.0]), 0.375, "{text}");
    }
    let text = "@group(0) @binding(0) var<uniform> frameIndex: u32;
        fn threshold(wpos: vec3f, dFoo: vec3f) -> f32 {
            return fract(wpos.x + dpdx(wpos).x - 0.125) + 0.0 * f32(frameIndex) + dFoo.x;
        }";
    let shader = wgsl(text, &options(&[("dFoo", "0,0,0")])).unwrap();
    assert_eq!(taken(&shader), ["`wpos` is taken for `position`", "`frameIndex` is taken for `frame`"]);
    assert_eq!(threshold(&shader, [0.375, 0.0, 0.0]), 0.375);
}

#[test]
fn what_could_be_either_is_asked_for() {
    for (text, wanted) in [
        ("float threshold(vec3 position, vec3 pos) { return pos.x; }", "--map position=pos"),
        ("float threshold(vec3 pos, vec3 coord) { return pos.x + coord.x; }", "--map position=pos"),
        ("float threshold(vec2 pos) { return pos.x; }", "--map pixel=pos"),
    ] {
        let error = glsl(text, &options(&[])).unwrap_err();
        assert!(error.contains(wanted), "{error}");
    }
    // A value that is given goes before a meaning that is guessed.
    let shader =
        glsl("float threshold(vec3 pos) { return pos.x; }", &options(&[("pos", "0.5,0,0")])).unwrap();
    assert!(shader.taken.is_empty());
    assert_eq!(threshold(&shader, [0.375, 0.0, 0.0]), 0.5);
}

#[test]
fn a_user_says_what_other_names_mean() {
    let map = |pairs: &[(&str, &str)]| Options {
        map: pairs.iter().map(|(value, name)| ((*value).to_owned(), (*name).to_owned())).collect(),
        ..Options::default()
    };
    let text = "uniform vec2 jitter;
        in vec3 there;
        float threshold(vec3 here, vec3 a, vec3 b) {
            return fract(here.x + a.x + b.y + length(dFdx(here)) - 0.5 + 0.0 * jitter.x * there.x);
        }";
    let asked = map(&[("position", "here"), ("dpdx", "a"), ("dpdy", "b"), ("pixel", "jitter")]);
    let error = glsl(text, &asked).unwrap_err();
    assert!(error.contains("`there` is filled before"), "{error}");
    let text = text.replace("* there.x", "");
    let shader = glsl(&text, &asked).unwrap();
    assert_eq!(threshold(&shader, [0.375, 0.0, 0.0]), 0.375);
    for (pair, wanted) in [
        (
            ("place", "here"),
            "--map place=here: a fragment has no `place`. It has position, dpdx, dpdy, pixel",
        ),
        (
            ("position", "gone"),
            "--map position=gone: no `gone` waits for a value. What does is here, a, b, jitter",
        ),
        (("lod", "here"), "--map lod=here: `here` is vec3<f32>, which nothing makes out of f32"),
    ] {
        let error = glsl(&text, &map(&[pair])).unwrap_err();
        assert!(error.contains(wanted), "{error}");
    }
}

#[test]
fn a_shader_between_quotes_is_found() {
    let quoted = |text: &str| {
        parse("own.js", Language::Quoted, text.as_bytes(), &options(&[])).map_err(|error| error.to_string())
    };
    let text = "import { x } from 'three';
export default /* glsl */ `
float threshold(vec3 position) {
    return fract(position.x) + y;
}
`;";
    let error = quoted(text).unwrap_err();
    assert!(error.starts_with("own.js:4:32: "), "{error}");
    for text in [
        &text.replace("+ y", ""),
        "S = '''\nfn threshold(position: vec3f) -> f32 { return fract(position.x); }\n'''",
        "#ifndef H\n#define H\nfloat threshold(vec3 position) { return fract(position.x); }\n#endif",
    ] {
        let shader = quoted(text).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(threshold(&shader, [0.375, 0.0, 0.0]), 0.375);
    }
    for (name, language) in [
        ("a.glsl.js", Language::Quoted),
        ("a.h", Language::Quoted),
        ("a.FSH", Language::Glsl),
        ("a.inc", Language::Glsl),
    ] {
        assert_eq!(Language::of(Path::new(name)), Some(language), "{name}");
    }
}

/// The preprocessor of naga loses its way in a comment that a condition leaves out.
#[test]
fn a_comment_in_a_skipped_group_is_a_comment() {
    let text = "/** first
 * and second */
float threshold(vec3 position) { /* here */ return fract(position.x); }
void main() {
#ifdef A
/* x */
#endif
}
#ifdef B
/* it's
 two */
// \"
#endif
#define C /* goes
 on */ 1
const int c = C;";
    let shader = glsl(text, &options(&[])).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(threshold(&shader, [0.375, 0.0, 0.0]), 0.375);
}

/// As a compiler writes them with `-g`.
#[test]
fn lines_of_a_source_in_spir_v_are_left_out() {
    let twin = export(Robust::new(Variant::Isotropic), export::Language::SpirV).unwrap().into_bytes();
    let mut words: Vec<u32> =
        twin.chunks_exact(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect();
    // Before every load: OpLine %1 1 1, and OpNoLine.
    let (mut at, mut loads) = (5, 0);
    while at < words.len() {
        if words[at] & 0xffff == 61 {
            words.splice(at..at, [4 << 16 | 8, 1, 1, 1, 1 << 16 | 317]);
            (at, loads) = (at + 5, loads + 1);
        }
        at += (words[at] >> 16) as usize;
    }
    assert!(loads > 0);
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    let read = |bytes: &[u8]| parse("own.spv", Language::SpirV, bytes, &options(&[])).unwrap();
    let of = |shader: &OwnShader| threshold(shader, [0.3, 0.2, 0.1]).to_bits();
    assert_eq!(of(&read(&bytes)), of(&read(&twin)));
}

#[test]
fn a_shader_of_godot_is_read() {
    let text = "shader_type spatial;
render_mode blend_mix, cull_disabled;
group_uniforms hash.inner;
uniform float strength : hint_range(0.0, 1.0, 0.1) = 0.5;
global uniform vec4 tint : source_color;
instance uniform float offset = 0.25;
uniform sampler2D albedo : source_color, filter_linear;
varying vec3 world_position;
float threshold() { return fract(world_position.x) * strength + offset; }
void fragment() { ALBEDO = texture(albedo, UV).rgb * tint.rgb; if (ALPHA < threshold()) { discard; } }";
    let shader = glsl(text, &options(&[])).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(taken(&shader), ["`world_position` is taken for `position`"]);
    assert_eq!(threshold(&shader, [0.375, 0.0, 0.0]), 0.4375);
    let shader = glsl(text, &options(&[("strength", "1")])).unwrap();
    assert_eq!(threshold(&shader, [0.375, 0.0, 0.0]), 0.625);
    assert_eq!(Language::of(Path::new("a.gdshader")), Some(Language::Glsl));
}

#[test]
fn what_is_never_reached_is_never_missed() {
    let text = "#include <common>
#include \"lighting.glsl\"
layout(push_constant) uniform PC { float scale; float other; } pc;
float threshold(vec3 position) { return fract(position.x) * pc.scale; }
void main() { light(common()); }";
    let shader = glsl(text, &options(&[("pc.scale", "0.5")])).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(threshold(&shader, [0.375, 0.0, 0.0]), 0.1875);
    let text = "#import a::{
    b::{C, D},
    e::f,
}
#import g::h
fn threshold(position: vec3f) -> f32 { return fract(position.x); }";
    let shader = wgsl(text, &options(&[])).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(threshold(&shader, [0.375, 0.0, 0.0]), 0.375);
}

/// Whether HLSL can be read here; with `HASHED_ALPHA_REQUIRE=compilers` it has to be.
fn reads_hlsl() -> bool {
    let required = std::env::var("HASHED_ALPHA_REQUIRE").is_ok_and(|list| list.contains("compilers"));
    required || std::process::Command::new("glslangValidator").arg("--version").output().is_ok()
}

fn hlsl(text: &str, options: &Options) -> Result<OwnShader, String> {
    parse("own.hlsl", Language::Hlsl, text.as_bytes(), options).map_err(|error| error.to_string())
}

#[test]
fn hlsl_is_read_by_way_of_spir_v() {
    if !reads_hlsl() {
        return;
    }
    let text = "#include \"Common.hlsl\"
Texture2D map : register(t0);
SamplerState state : register(s0);
cbuffer Params : register(b0) { float4 tint; float strength; };
struct Varyings { float4 clip : SV_Position; float3 world : TEXCOORD0; };
float lost(float2 uv) { return map.Sample(state, uv).a * fromCommon(uv); }
half size(half3 p) { return length(ddx(p)); }
#ifdef EXTRA
float extra() { return 0.25; }
#else
float extra() { return 0.0; }
#endif
float threshold(in float3 positionWS, float2 pixel : SV_Position) {
    float3 p = positionWS;
    return frac(p.x) * strength + size(p) - 0.125 + extra() + 0.0 * pixel.x;
}
float4 main(Varyings i) : SV_Target { clip(lost(i.clip.xy) - threshold(i.world, i.clip.xy)); return tint; }";
    let shader = hlsl(text, &options(&[("strength", "0.5")])).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(taken(&shader), ["`positionWS` is taken for `position`"]);
    assert_eq!(threshold(&shader, [0.375, 0.0, 0.0]), 0.1875);
    let shader = hlsl(text, &options(&[("strength", "0.5"), ("EXTRA", "1")])).unwrap();
    assert_eq!(threshold(&shader, [0.375, 0.0, 0.0]), 0.4375);
    for (wrong, wanted) in [
        (text.replace("frac(p.x)", "frac(q.x)"), "own.hlsl:15:1: "),
        (text.replace("float threshold(", "float other("), "functions are lost, size, extra, other, main"),
        (text.replace("extra()", "lost(p.xy)"), "own.hlsl:"),
        (
            text.to_owned(),
            "own.hlsl: `strength` of uniform block `Params` has no value: --set Params.strength=VALUE",
        ),
    ] {
        let error = hlsl(&wrong, &options(&[])).unwrap_err();
        assert!(error.contains(wanted), "{error}");
    }
}

#[test]
fn exported_hlsl_is_the_same_threshold() {
    for (language, is_read) in [(Language::Hlsl, reads_hlsl()), (Language::Slang, reads_slang())] {
        if !is_read {
            continue;
        }
        for variant in [Variant::Isotropic, Variant::Anisotropic] {
            let of = |written: export::Language, language| {
                let bytes = export(Robust::new(variant), written).unwrap().into_bytes();
                let shader = parse(written.name(), language, &bytes, &options(&[]));
                threshold(&shader.unwrap_or_else(|error| panic!("{error}")), [0.3, -12.5, 1.0e3])
            };
            assert_eq!(of(export::Language::Hlsl, language), of(export::Language::Wgsl, Language::Wgsl));
        }
    }
}

/// Whether Slang can be read here; with `HASHED_ALPHA_REQUIRE=slang` it has to be.
fn reads_slang() -> bool {
    let required = std::env::var("HASHED_ALPHA_REQUIRE").is_ok_and(|list| list.contains("slang"));
    required || std::process::Command::new("slangc").arg("-v").output().is_ok()
}

#[test]
fn slang_is_read_by_way_of_wgsl() {
    if !reads_slang() {
        return;
    }
    let text = "import size;
static const float K = 0.25;
cbuffer Params { float strength; float4x4 unused; };
uniform float more;
Texture2D map; SamplerState state;
interface INoise { static float of(float3 p); };
struct Ramp : INoise { static float of(float3 p) { return frac(p.x) * strength; } };
float generic<N : INoise>(float3 p) { let size = longer(p); return N.of(p) + size - 0.25 - K + more; }
float threshold(float3 positionWS) { return generic<Ramp>(positionWS); }
struct Varyings { float4 clip : SV_Position; float3 world : POSITION0; float2 uv : TEXCOORD; };
[shader(\"fragment\")]
float4 psMain(Varyings i) : SV_Target {
    float4 c = map.Sample(state, i.uv);
    if (c.a < threshold(i.world)) discard;
    return c;
}
void keep(Varyings i, inout float alpha, bool isOn) { if (isOn && alpha < threshold(i.world)) alpha = 0; }
";
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/own_shader/slang");
    let slang = |text: &str, function: &str, settings: &[(&str, &str)]| {
        let options =
            Options { include: vec![folder.clone()], function: function.to_owned(), ..options(settings) };
        parse("own.slang", Language::Slang, text.as_bytes(), &options).map_err(|error| error.to_string())
    };
    let set = [("strength", "0.5"), ("more", "0.25")];
    for function in ["threshold", "psMain", "keep"] {
        let shader = slang(text, function, &set).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(threshold(&shader, [0.375, 0.0, 0.0]), 0.1875, "{function}");
    }
    for (wrong, wanted) in [
        (text.replace("frac(p.x)", "frac(q.x)"), "own.slang:7:1: "),
        (text.replace("import size", "import missing"), "own.slang:8:1: undefined identifier 'longer'"),
        (text.replace("import size", "import missing"), "'missing.slang' -I DIR names a folder to look in"),
        (text.replace("float threshold(", "float other("), "functions are generic, other, psMain, keep"),
        (
            text.to_owned(),
            "own.slang: `strength` of uniform block `Params` has no value: --set Params.strength=VALUE",
        ),
    ] {
        let error = slang(&wrong, "threshold", &[]).unwrap_err();
        assert!(error.contains(wanted), "{error}");
    }
}
