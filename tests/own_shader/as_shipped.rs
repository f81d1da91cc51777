//! Files as people ship them: tests of an alpha, structures, includes, an engine's conditions, numbers of 16 bits.

use super::*;

fn named(function: &str) -> Options {
    Options { function: function.to_owned(), ..Options::default() }
}

fn mapped(function: &str, map: &[(&str, &str)]) -> Options {
    let map = map.iter().map(|(key, name)| ((*key).to_owned(), (*name).to_owned())).collect();
    Options { map, ..named(function) }
}

/// A threshold that every text below has under some name.
const HASH: &str =
    "float hash(vec3 p) { return fract(dot(p, vec3(0.375, 0.25, 0.125)) + 0.0 * length(dFdx(p))); }\n";
const HASH_WGSL: &str =
    "fn hash(p: vec3f) -> f32 { return fract(dot(p, vec3f(0.375, 0.25, 0.125)) + 0.0 * length(dpdx(p))); }\n";
const AT: [f64; 3] = [1.5, -0.25, 3.0];

/// That of [`AT`].
const WANTED: f32 = 1.5 * 0.375 - 0.25 * 0.25 + 3.0 * 0.125;

#[test]
fn a_test_of_an_alpha_is_the_threshold_that_it_compares_with() {
    let lines = "vec4 c = texture(map, uv);\nif (c.a < 0.01) discard;\nif (fog) c.rgb *= 2.0;\n";
    for (text, function) in [
        (
            format!(
                "{HASH}in vec3 vPosition; void main() {{ {lines} if (c.a < hash(vPosition)) discard; color = lit(c); }}"
            ),
            "main",
        ),
        (
            format!(
                "{HASH}in vec3 vPosition; void main() {{ {lines} float t = hash(vPosition); if (hashed) {{ if (t > c.a) {{ discard; }} }} else {{ t = 0.5; }} }}"
            ),
            "main",
        ),
        (format!("{HASH}bool keep(float alpha, vec3 pos) {{ return alpha >= hash(pos); }}"), "keep"),
        (
            format!(
                "{HASH}bool drop(vec4 color, vec3 pos) {{ float t = hash(pos); return color.a < t ? true : false; }}"
            ),
            "drop",
        ),
        (format!("{HASH}void test(vec3 pos, float alpha) {{ if (!(alpha >= hash(pos))) discard; }}"), "test"),
        (
            format!("{HASH}void test(inout float alpha, vec3 pos) {{ alpha = step(hash(pos), alpha); }}"),
            "test",
        ),
        (
            format!(
                "{HASH}void test(inout vec4 color, vec3 pos) {{ if (color.a < hash(pos)) color.a = 0.0; }}"
            ),
            "test",
        ),
        (
            format!(
                "{HASH}float test(float opacity, vec3 pos) {{ return opacity < hash(pos) ? 0.0 : 1.0; }}"
            ),
            "test",
        ),
        (
            format!("{HASH}in vec3 vPosition; void main() {{ vec4 c; if (c.a - hash(vPosition) < 0.0) discard; }}"),
            "main",
        ),
        (
            format!("{HASH}in vec3 vPosition; void main() {{ vec4 c; if (step(hash(vPosition), c.a) == 0.0) discard; }}"),
            "main",
        ),
        (
            format!(
                "{HASH}in vec3 vPosition; void main() {{ vec4 c; if (all(lessThan(vec2(c.a), vec2(hash(vPosition))))) discard; }}"
            ),
            "main",
        ),
        (
            format!(
                "{HASH}void mask(float x, float y) {{ if (x < y) discard; }} in vec3 vPosition;
                 void main() {{ vec4 c = texture(map, uv); mask(c.a, hash(vPosition)); color = lit(c); }}"
            ),
            "main",
        ),
        (
            format!(
                "struct Cover {{ vec3 position; float alpha; float threshold; bool gone; }};
                 {HASH}void cover(inout Cover c) {{ c.threshold = hash(c.position); c.gone = c.alpha < c.threshold; }}"
            ),
            "cover",
        ),
        (
            format!(
                "struct Cover {{ float threshold; bool kept; }};
                 {HASH}void cover(vec3 pos, float alpha, out Cover c) {{ c.threshold = hash(pos); c.kept = alpha >= c.threshold; }}"
            ),
            "cover",
        ),
        (
            format!("{HASH}float test(vec3 p, float k) {{ return k * hash(p); }} float test(vec3 p) {{ return test(p, 1.0); }}"),
            "test",
        ),
    ] {
        let shader = glsl(&text, &named(function)).unwrap_or_else(|error| panic!("{error}: {text}"));
        assert_eq!(threshold(&shader, AT), WANTED, "{text}");
        if text.contains("float test(vec3 p)") {
            continue;
        }
        assert!(
            shader.notes[0].starts_with("the threshold is what `") && !shader.notes[0].contains("halving"),
            "{text}"
        );
    }
    let wgsl_text = format!(
        "{HASH_WGSL}struct In {{ @builtin(position) position: vec4f, @location(0) local_position: vec3f, @location(1) uv: vec2f }}
@group(0) @binding(0) var map: texture_2d<f32>; @group(0) @binding(1) var samp: sampler;
@fragment fn fs(in: In, @builtin(front_facing) front: bool) -> @location(0) vec4f {{
    let c = textureSample(map, samp, in.uv);
    if c.a < hash(in.local_position) {{ discard; }}
    return c;
}}"
    );
    let shader = wgsl(&wgsl_text, &named("fs")).unwrap();
    assert_eq!(threshold(&shader, AT), WANTED);
    // Which one is meant goes without saying.
    assert_eq!(threshold(&wgsl(&wgsl_text, &Options::default()).unwrap(), AT), WANTED);
}

#[test]
fn the_threshold_of_any_other_test_is_found_by_halving() {
    for text in [
        format!(
            "{HASH}bool test(float alpha, vec3 pos) {{ float b = sqrt(alpha); bool kept = b * b >= hash(pos); return kept; }}"
        ),
        format!("{HASH}bool test(float alpha, vec3 pos) {{ alpha *= 0.5; return alpha < 0.5 * hash(pos); }}"),
        format!(
            "{HASH}void test(inout vec4 color, vec3 pos) {{ color.a = color.a - hash(pos) < 0.0 ? 0.0 : 1.0; }}"
        ),
        format!(
            "{HASH}void inner(float x, float y) {{ if (x < y) discard; }} void test(float alpha, vec3 pos) {{ inner(alpha, hash(pos)); }}"
        ),
        format!(
            "{HASH}float test(float opacity, vec3 pos) {{ for (int i = 0; i < 3; i++) {{ if (opacity < hash(pos)) return 0.0; }} return opacity; }}"
        ),
    ] {
        let shader = glsl(&text, &named("test")).unwrap_or_else(|error| panic!("{error}: {text}"));
        let found = threshold(&shader, AT);
        assert!((found - WANTED).abs() <= 2.0 * f32::EPSILON, "{found}, not {WANTED}: {text}");
    }
    let exact = format!(
        "{HASH}bool test(float k, vec3 pos) {{ float t = hash(pos); bool kept = 2.0 * k >= 2.0 * t; return kept; }}"
    );
    let shader = glsl(&exact, &mapped("test", &[("alpha", "k")])).unwrap();
    assert_eq!(threshold(&shader, AT), WANTED);
    assert_eq!(shader.notes, ["`test` is a test of `k`: its threshold is found by halving"]);
    // All are kept, none are, and those between two thresholds.
    for (comparison, wanted) in
        [("2.0 * alpha >= 0.0 * t", 0.0), ("2.0 * alpha > 2.0 + t", 1.0 + f32::EPSILON)]
    {
        let text = format!(
            "{HASH}void test(float alpha, vec3 pos) {{ float t = hash(pos); bool keep = {comparison}; if (!keep) discard; }}"
        );
        assert_eq!(threshold(&glsl(&text, &named("test")).unwrap(), AT), wanted, "{comparison}");
    }
    let between = format!(
        "{HASH}bool test(float alpha, vec3 pos) {{ float t = hash(pos); return abs(alpha - 0.5) < 0.25; }}"
    );
    assert!(threshold(&glsl(&between, &named("test")).unwrap(), AT).is_nan());
}

#[test]
fn what_is_no_plain_test_is_not_read_as_one() {
    let function = |body: &str| format!("{HASH}vec3 g; void init(vec3 p) {{ g = p + 1.0; }} {body}");
    let values = [
        // More terms than two.
        ("void f(float alpha, vec3 pos) { if (alpha - hash(pos) + 0.125 < 0.0) discard; }", WANTED - 0.125),
        // A threshold that is handed the alpha, and one that is cut off.
        (
            "float t(float alpha, vec3 p) { return hash(p); } bool f(float alpha, vec3 pos) { return alpha >= t(alpha, pos); }",
            WANTED,
        ),
        ("bool f(float alpha, vec3 pos) { return alpha >= 0.9375 && alpha >= hash(pos); }", 0.9375),
        // What a call leaves behind.
        (
            "void f(float alpha, vec3 pos) { g = pos; init(pos); if (alpha < hash(g)) discard; }",
            WANTED + 0.75 - 1.0,
        ),
        (
            "void cut(float a, float t) { t *= 0.5; if (a < t) discard; } void f(float alpha, vec3 pos) { cut(alpha, hash(pos)); }",
            0.5 * WANTED,
        ),
        ("bool f(float alpha, vec3 pos) { return alpha < hash(pos) ? false : true; }", WANTED),
    ];
    for (body, wanted) in values {
        let shader = glsl(&function(body), &named("f")).unwrap_or_else(|error| panic!("{error}: {body}"));
        let found = threshold(&shader, AT);
        assert!((found - wanted).abs() < 1.0e-6, "{found}, not {wanted}: {body}");
    }
    let main = |body: &str| {
        let text = format!("{HASH}in vec3 vPosition;\nvoid main() {{ vec4 c = texture(map, uv);\n{body} }}");
        glsl(&text, &named("main"))
    };
    for refused in [
        "if (c.a - hash(vPosition) + 0.1 < 0.0) discard;",
        "if (1.0 - c.a > hash(vPosition)) discard;",
        "if (1.0 - step(hash(vPosition), c.a) > 0.5) discard;",
    ] {
        let error = main(refused).unwrap_err();
        assert!(error.contains("`main` has no test of an alpha that is found"), "{error}: {refused}");
    }
    for reversed in [
        "if (c.a < hash(vPosition) ? false : true) discard;",
        "if (any(not(lessThan(vec2(c.a), vec2(hash(vPosition)))))) discard;",
    ] {
        assert!(main(reversed).unwrap_err().contains("own.glsl:4:"), "{reversed}");
    }
    let ends = format!(
        "{HASH}bool f(float alpha, vec3 pos) {{ if (alpha >= 1.0) return true; return alpha >= hash(pos); }}"
    );
    assert!(glsl(&ends, &named("f")).unwrap().notes[0].starts_with("the threshold is what `alpha`"));
    // What else the alpha is compared with is told.
    let twice = main("if (c.a < 0.5) discard;\nif (c.a < hash(vPosition)) discard;").unwrap();
    assert_eq!(
        twice.notes,
        [
            "the threshold is what `c.a` is compared with in line 5, in `main`: `hash(vPosition)`; it is compared in line 4, too, which is left out"
        ]
    );
    let twice = format!(
        "{HASH_WGSL}struct In {{ @location(0) pos: vec3f, @location(1) color: vec4f }}
@fragment fn fs(in: In) {{ let c = in.color;
if c.a < 0.5 {{ discard; }}
if c.a < hash(in.pos) {{ discard; }} }}"
    );
    let notes = wgsl(&twice, &named("fs")).unwrap().notes;
    assert!(
        notes[0].contains("in line 5")
            && notes[0].ends_with("it is compared in line 4, too, which is left out"),
        "{notes:?}"
    );
    let pointer = format!(
        "{HASH_WGSL}fn f(alpha: f32, pos: vec3f) -> bool {{ var p = pos; let r = &p; *r += 1.0; return alpha >= hash(p); }}"
    );
    let found = threshold(&wgsl(&pointer, &named("f")).unwrap(), AT);
    assert!((found - (WANTED + 0.75 - 1.0)).abs() < 1.0e-6, "{found}");
    // A member that is changed has a value before.
    let changed = "struct S { vec3 pos; float t; }; float threshold(S s) { s.t = 0.0; s.pos += 0.25; return fract(s.pos.x + s.t); }";
    assert_eq!(threshold(&glsl(changed, &options(&[])).unwrap(), [0.5, 0.0, 0.0]), 0.75);
    // Exact names, of any type that a value can be made into.
    let exact = "in vec3 position; float threshold(float frame, vec4 pixel) { return fract(position.x) + 0.0 * frame * pixel.w; }";
    assert_eq!(threshold(&glsl(exact, &options(&[])).unwrap(), [0.375, 0.0, 0.0]), 0.375);
    let other = "#ifdef LOW\nfloat threshold(vec3 p) { return 0.5; }\n#else\nfloat threshold(vec3 p) { return fract(p.x); }\n#endif";
    assert_eq!(threshold(&glsl(other, &options(&[])).unwrap(), [0.375, 0.0, 0.0]), 0.375);
    let hole = "fn threshold(p: vec3f) -> f32 { return fract(p.x) * #{SCALE}; }";
    assert_eq!(threshold(&wgsl(hole, &options(&[("SCALE", "0.5")])).unwrap(), [0.5, 0.0, 0.0]), 0.25);
}

#[test]
fn a_test_the_wrong_way_around_is_told_with_its_line() {
    let text =
        format!("{HASH}void main() {{\n  vec4 c = texture(map, uv);\n  if (c.a > hash(vPos)) discard;\n}}");
    let error = glsl(&text, &named("main")).unwrap_err();
    assert!(
        error.starts_with("own.glsl:4:7: a fragment is discarded here where `c.a` is above `hash(vPos)`"),
        "{error}"
    );
    let error = glsl(
        &format!("{HASH}float test(vec3 pos, float k) {{ return hash(pos); }}"),
        &mapped("test", &[("alpha", "j")]),
    );
    assert!(error.unwrap_err().contains("--map alpha=j: `test` has no test of `j`"));
}

#[test]
fn structures_blocks_and_pushed_constants_are_taken_apart() {
    let text = format!(
        "#version 450
in Varyings {{ vec3 objPos; vec3 normal; vec2 uv; }} inputs;
layout(push_constant) uniform Pushed {{ mat4 model; float scale; uint frameIndex; }} pushed;
{HASH}float threshold() {{ return hash(inputs.objPos * pushed.scale) + 0.0 * float(pushed.frameIndex); }}"
    );
    let shader = glsl(&text, &options(&[("pushed.scale", "2")])).unwrap();
    assert_eq!(threshold(&shader, AT.map(|x| x / 2.0)), WANTED);
    let taken: Vec<_> = shader.taken.iter().map(ToString::to_string).collect();
    assert_eq!(taken, ["`objPos` is taken for `position`", "`frameIndex` is taken for `frame`"]);
    let unset = text.replace("inputs.objPos *", "inputs.objPos * inputs.normal *");
    let error = glsl(&unset, &options(&[("scale", "2")])).unwrap_err();
    assert!(error.contains("`inputs.normal` has no value"), "{error}");
    // The place on the screen may have any name.
    let text = "struct In { @builtin(position) position: vec4f, @location(0) pos: vec3f }
fn threshold(in: In) -> f32 { return fract(in.pos.x) + 0.0 * in.position.x; }";
    let shader = wgsl(text, &options(&[])).unwrap();
    assert_eq!(threshold(&shader, [0.75, 0.0, 0.0]), 0.75);
    let taken: Vec<_> = shader.taken.iter().map(ToString::to_string).collect();
    assert_eq!(taken, ["`pos` is taken for `position`", "`position` is taken for `pixel`"]);
}

#[test]
fn the_size_of_a_pixel_may_be_handed_in() {
    let text = "float threshold(vec3 pos, float pixelSize) { return fract(pos.x / pixelSize); }";
    let shader = glsl(text, &options(&[])).unwrap();
    // The longer of 1/8 and 1/4.
    assert_eq!(threshold(&shader, [0.0625, 0.0, 0.0]), 0.25);
    let text = "fn threshold(pos: vec3f, d: vec3f) -> f32 { return fract(pos.x / d.x + pos.y / d.y); }";
    let shader = wgsl(text, &mapped("threshold", &[("pixel_size", "d")])).unwrap();
    assert_eq!(threshold(&shader, [0.0625, 0.0625, 0.0]), 0.75);
    let text = "float threshold(vec3 pos, vec2 uv) { return fract(pos.x * 8.0 * length(dFdx(uv))); }";
    assert_eq!(threshold(&glsl(text, &options(&[])).unwrap(), [0.375, 0.0, 0.0]), 0.375);
}

#[test]
fn what_an_engine_declares_elsewhere_is_put_in() {
    let text = format!("{HASH}float threshold() {{ return hash(vPosition * block.scale + offset); }}");
    let shader = glsl(&text, &options(&[("block.scale", "2"), ("offset", "0,0,0")])).unwrap();
    assert_eq!(threshold(&shader, AT.map(|x| x / 2.0)), WANTED);
    assert_eq!(shader.taken[0].to_string(), "`vPosition` is taken for `position`");
    let error = glsl(&text, &options(&[("offset", "0,0,0")])).unwrap_err();
    assert!(error.contains("own.glsl:2:45: `block` has no value"), "{error}");
    // As Babylon writes WGSL.
    let text = format!(
        "varying vPosition: vec3f;\nuniform hashScale: f32;\n#include<helperFunctions>\n{HASH_WGSL}
fn kept(alpha: f32) -> bool {{ return alpha >= hash(fragmentInputs.vPosition * uniforms.hashScale); }}"
    );
    let shader = wgsl(&text, &named("kept")).unwrap();
    assert_eq!(threshold(&shader, AT), WANTED);
    assert_eq!(shader.hash_scale(), Some(1.0));
    // A matrix is set column by column.
    let text = "uniform mat3 turn;\nfloat threshold(vec3 pos) { return fract((turn * pos).x); }";
    let shader = glsl(text, &options(&[("turn", "0,0,0,1,0,0,0,0,0")])).unwrap();
    assert_eq!(threshold(&shader, [0.25, 0.375, 0.0]), 0.375);
    let error = glsl(text, &options(&[("turn", "1,2")])).unwrap_err();
    assert!(error.contains("`turn` is a matrix of f32 and takes 9 values"), "{error}");
    let text = "struct Params { float scale; };\nuniform Params params;\nfloat threshold(vec3 pos) { return fract(pos.x * params.scale); }";
    assert_eq!(threshold(&glsl(text, &options(&[("params.scale", "2")])).unwrap(), [0.25, 0.0, 0.0]), 0.5);
    assert!(
        glsl(text, &options(&[])).unwrap_err().contains("`scale` of uniform block `params` has no value")
    );
    let text =
        "struct In { vec3 pos; float scale; };\nfloat threshold(In i) { return fract(i.pos.x * i.scale); }";
    assert_eq!(threshold(&glsl(text, &options(&[("i.scale", "2")])).unwrap(), [0.25, 0.0, 0.0]), 0.5);
}

#[test]
fn files_that_are_there_are_included() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
        path
    };
    write(
        "lib/hash.glsl",
        "#pragma once\n#include \"more.glsl\"\nfloat hash(vec3 p) { return fract(more(p.x)); }\n",
    );
    write("lib/more.glsl", "float more(float x) { return x * 2.0; }\n#include \"hash.glsl\"\n");
    let main = write(
        "main.frag",
        "#include \"nowhere.glsl\"\n#include \"hash.glsl\"\n\nfloat threshold(vec3 pos) { return hash(pos) + lost; }\n",
    );
    let with = Options { include: vec![folder.path().join("lib")], ..Options::default() };
    let error = read(&main, &with).unwrap_err().to_string();
    assert!(error.contains("main.frag:4:48: `lost` has no value"), "{error}");
    let text = std::fs::read_to_string(&main).unwrap().replace(" + lost", "");
    std::fs::write(&main, &text).unwrap();
    assert_eq!(threshold(&read(&main, &with).unwrap(), [0.375, 0.0, 0.0]), 0.75);
    let error = read(&main, &Options::default()).unwrap_err().to_string();
    assert!(error.contains("`#include \"hash.glsl\"` may have it, which is neither"), "{error}");
    // A mistake in one is told in it.
    write("lib/more.glsl", "\n\nfloat more(float x) { return x * y; }\n");
    let error = read(&main, &with).unwrap_err();
    assert!(error.to_string().contains("more.glsl:3:34: `y` has no value"), "{error}");
    write("lib/more.glsl", "float more(float x) { return x; /* }\n");
    let error = read(&main, &with).unwrap_err().to_string();
    assert!(error.contains("more.glsl:1:33: a comment that does not end"), "{error}");
}

#[test]
fn an_engines_own_preprocessor_is_carried_out() {
    let text = "#import bevy_pbr::{\n    mesh_functions,\n    forward_io::{VertexOutput, FragmentOutput},\n    utils::hash,\n}
#ifdef HASHED\nfn threshold(pos: vec3f) -> f32 { return fract(pos.x) * FACTOR; }\n#else\nfn other(pos: Unknown) {}\n#endif
#if SAMPLES > 1\nconst FACTOR = 0.5;\n#else\nconst FACTOR = 1.0;\n#endif
@group(#{MATERIAL}) @binding(0) var<uniform> material: Material;
@fragment fn fragment(in: VertexOutput) -> @location(0) vec4f { return shade(in); }";
    let shader = wgsl(text, &options(&[("SAMPLES", "4")])).unwrap();
    assert_eq!(threshold(&shader, [0.75, 0.0, 0.0]), 0.375);
    assert_eq!(threshold(&wgsl(text, &options(&[])).unwrap(), [0.75, 0.0, 0.0]), 0.75);
    let dead =
        "#if 0\nfloat threshold(vec3 p) { return (((\n#endif\nfloat threshold(vec3 p) { return fract(p.x); }";
    assert_eq!(threshold(&glsl(dead, &options(&[])).unwrap(), [0.75, 0.0, 0.0]), 0.75);
}

#[test]
fn numbers_of_16_bits_are_computed_in_32_and_said_so() {
    let note = |word: &str| {
        format!(
            "`{word}` is computed in 32 bits; what 16 make of the threshold on a device that has them is tried with --on device-model"
        )
    };
    for (text, word) in [
        ("half threshold(vec3 position) { half x = position.x; return fract(x); }", "half"),
        ("float16_t threshold(f16vec3 position) { return float16_t(fract(position.x)); }", "float16_t"),
        (
            "precision mediump float;\nfloat threshold(mediump vec3 position) { return fract(position.x); }",
            "mediump",
        ),
    ] {
        let shader = glsl(text, &options(&[])).unwrap_or_else(|error| panic!("{error}: {text}"));
        assert_eq!(threshold(&shader, [0.375, 0.0, 0.0]), 0.375);
        assert_eq!(shader.notes, [note(word)], "{text}");
    }
    let text = "enable f16;\nfn threshold(position: vec3<f32>) -> f16 { let p = vec3h(position); return fract(p.x * 2.0h); }";
    let shader = wgsl(text, &options(&[])).unwrap();
    assert_eq!((threshold(&shader, [0.375, 0.0, 0.0]), shader.notes.len()), (0.75, 1));
    assert!(
        glsl("#define half float\nfloat threshold(vec3 position) { half x = 0.5; return x; }", &options(&[]))
            .is_ok()
    );
}

#[test]
fn the_function_that_sounds_like_it_is_taken() {
    let text = format!(
        "{HASH}float getAlphaHashThreshold(vec3 p) {{ return hash(p); }} float other() {{ return 1.0; }}"
    );
    let shader = glsl(&text, &Options::default()).unwrap();
    assert_eq!(threshold(&shader, AT), WANTED);
    assert!(shader.notes[0].contains("`getAlphaHashThreshold` is taken for it"), "{:?}", shader.notes);
    let two = format!("{text} float alphaHashThreshold(vec3 p) {{ return 1.0; }}");
    assert!(glsl(&two, &Options::default()).unwrap_err().contains("there is no function `threshold`"));
}

#[test]
fn what_stands_around_a_shader_is_no_obstacle() {
    let parsed = |file: &str, language, text: &str, options: &Options| {
        parse(file, language, text.as_bytes(), options).map_err(|error| error.to_string())
    };
    // An engine's words around it.
    let godot = format!(
        "#[vertex]\nvoid main() {{}}\n#[fragment]\n#VERSION_DEFINES\nin vec3 vPosition; {HASH} void main() {{ vec4 c = texture(m, uv); if (c.a < hash(vPosition)) discard; }}"
    );
    assert_eq!(threshold(&glsl(&godot, &Options::default()).unwrap(), AT), WANTED);
    let material = format!(
        "material {{ name : leaf }}\nfragment {{\n{HASH} float alphaThreshold(vec3 pos) {{ return hash(pos); }}\n}}\n"
    );
    assert_eq!(
        threshold(&parsed("a.mat", Language::Any, &material, &Options::default()).unwrap(), AT),
        WANTED
    );
    let rust = format!(
        "const A: &'static str = r#\"{HASH_WGSL}fn alpha_threshold(pos: vec3f) -> f32 {{ return hash(pos); }}\"#;"
    );
    assert_eq!(threshold(&parsed("a.rs", Language::Quoted, &rust, &Options::default()).unwrap(), AT), WANTED);
    // What only the program knows is told.
    let script = format!(
        "const a = `{HASH}const float k = ${{scale}};\nfloat alphaThreshold(vec3 pos) {{ return hash(pos) * k; }}`;"
    );
    let error = parsed("a.js", Language::Quoted, &script, &Options::default()).unwrap_err();
    assert!(error.contains("a.js:2:") && error.contains("what stands in `${...}` is left empty"), "{error}");
    // Types and layouts of extensions.
    let vulkan = format!(
        "struct P {{ uint64_t address; float k; }}; layout(push_constant, scalar) uniform B {{ P pc; }};\n{HASH}float threshold(vec3 position) {{ return hash(position) * pc.k; }}"
    );
    for (name, value) in [("pc.k", "1"), ("B.pc.k", "1"), ("k", "1")] {
        assert_eq!(threshold(&glsl(&vulkan, &options(&[(name, value)])).unwrap(), AT), WANTED, "{name}");
    }
    let error = glsl(&vulkan, &options(&[])).unwrap_err();
    assert!(error.contains("`k` of uniform block `B` has no value: --set B.pc.k=VALUE"), "{error}");
}

#[test]
fn what_helpers_stand_behind_is_defined() {
    let text = format!(
        "#if HASHED\n#define LOW(x) (x)\n#endif\n#ifdef NOISE\n{HASH}#endif\nfloat threshold(vec3 position) {{ return LOW(hash(position)); }}"
    );
    let shader = glsl(&text, &options(&[])).unwrap();
    assert_eq!(threshold(&shader, AT), WANTED);
    let notes: Vec<_> = shader.notes.iter().map(|note| note.split(',').next().unwrap()).collect();
    assert!(
        notes.contains(&"`HASHED` is defined as 1") && notes.contains(&"`NOISE` is defined as 1"),
        "{notes:?}"
    );
    // Another branch defines it: nothing is asked for.
    let text = format!(
        "#ifdef FAST\n#define H(p) 0.5\n#else\n#define H(p) hash(p)\n#endif\n{HASH}float threshold(vec3 position) {{ return H(position); }}"
    );
    let shader = glsl(&text, &options(&[])).unwrap();
    assert_eq!((threshold(&shader, AT), shader.notes.len()), (WANTED, 0));
    // A name that is nowhere, in a branch.
    let text = format!(
        "{HASH}float threshold(vec3 position) {{\n#if KIND == BAYER\nreturn bayer(position.xy);\n#else\nreturn hash(position);\n#endif\n}}"
    );
    let error = glsl(&text, &options(&[])).unwrap_err();
    assert!(error.contains("'bayer' (behind `#if KIND == BAYER`: --set NAME=VALUE"), "{error}");
}

#[test]
fn the_size_of_the_noise_goes_by_its_own_name() {
    let text = "uniform float uHashScale; float threshold(vec3 position) { return fract(uHashScale * 0.25 + 0.0 * position.x); }";
    for (settings, wanted) in [(&[][..], 1.0), (&[("uHashScale", "2")], 2.0), (&[("hash_scale", "2")], 2.0)] {
        let shader = glsl(text, &options(settings)).unwrap();
        assert_eq!(
            (shader.hash_scale(), threshold(&shader, AT)),
            (Some(wanted), 0.25 * wanted),
            "{settings:?}"
        );
    }
    for wrong in ["0", "-1", "inf"] {
        let error = glsl(text, &options(&[("uHashScale", wrong)])).unwrap_err();
        assert!(error.contains("is finite and above 0"), "{error}");
    }
}

#[test]
fn a_test_that_is_the_wrong_way_around_elsewhere_is_told() {
    let of = |sign: &str| {
        let text = format!(
            "{HASH}in vec3 vPosition;\nfloat alphaThreshold(vec3 pos) {{ return hash(pos); }}\nvoid main() {{ vec4 c = texture(m, uv);\nif (c.a {sign} alphaThreshold(vPosition)) discard; }}"
        );
        glsl(&text, &options(&[])).unwrap().notes
    };
    assert!(
        of(">")
            .iter()
            .any(|note| note.starts_with("line 5: a fragment is discarded here where `c.a` is above"))
    );
    assert!(!of("<").iter().any(|note| note.contains("discarded here")));
}

#[test]
fn structures_that_only_an_engine_declares_are_no_obstacle() {
    let bevy = format!(
        "#import bevy_pbr::forward_io::{{VertexOutput, FragmentOutput}}\n{HASH_WGSL}@fragment fn fragment(in: VertexOutput, @builtin(front_facing) f: bool) -> FragmentOutput {{\n\
         var base = pbr_input_from_standard_material(in, f);\nif base.color.a < hash(in.world_position.xyz) {{ discard; }} var out: FragmentOutput; return out; }}"
    );
    let shader = wgsl(&bevy, &options(&[])).unwrap();
    assert_eq!(threshold(&shader, AT), WANTED);
    assert!(shader.taken.iter().any(|taken| taken.name == "world_position"), "{:?}", shader.taken);
    let cesium = format!(
        "{HASH}void fragmentMain(FragmentInput fsInput, inout czm_modelMaterial material) {{ vec3 p = fsInput.attributes.positionMC; if (material.alpha < hash(p)) discard; }}"
    );
    assert_eq!(threshold(&glsl(&cesium, &options(&[])).unwrap(), AT), WANTED);
    let other = cesium.replace("positionMC", "where");
    assert_eq!(
        threshold(&glsl(&other, &mapped("fragmentMain", &[("position", "where")])).unwrap(), AT),
        WANTED
    );
}

#[test]
fn a_program_puts_texts_together() {
    let python = format!(
        "HASH = \"\"\"\n{HASH}\"\"\"\nFRAGMENT = \"\"\"\n#version 330\nin vec3 obj_pos;\n%(hash)s\nvoid main() {{ vec4 c = texture(t, uv);\nif (c.a < hash(obj_pos)) discard; }}\n\"\"\" % {{\"hash\": HASH}}\n"
    );
    let script = format!(
        "const common = `{HASH}`;\nconst other = `float unused() {{ return 1.0; }}`;\nconst a = `${{common}}\nfloat alphaThreshold(vec3 pos) {{ return hash(pos); }}`;"
    );
    for (file, text) in [("a.py", python), ("a.js", script)] {
        let shader = parse(file, Language::Quoted, text.as_bytes(), &options(&[]));
        assert_eq!(threshold(&shader.unwrap_or_else(|error| panic!("{error}")), AT), WANTED, "{file}");
    }
}

#[test]
fn what_a_test_stands_behind_is_told() {
    let of = |body: &str| {
        let text = format!("{HASH}in vec3 vPosition; void main() {{ vec4 c = texture(m, uv); {body} }}");
        glsl(&text, &options(&[])).unwrap().notes.pop().unwrap()
    };
    assert!(!of("if (c.a < hash(vPosition)) discard;").contains("stands behind"));
    assert!(!of("bool gone = c.a < hash(vPosition); if (gone) discard;").contains("stands behind"));
    let note = of("if (gl_FrontFacing) { if (c.a < hash(vPosition)) discard; }");
    assert!(note.ends_with("it stands behind `gl_FrontFacing`, elsewhere nothing is looked at"), "{note}");
    let note = of("if (c.r > 0.5) { return; } if (c.a < hash(vPosition)) discard;");
    assert!(
        note.ends_with("it stands behind `c.r > 0.5` where it fails, elsewhere nothing is looked at"),
        "{note}"
    );
    // The wrong way around is a test, and told as that, though no function is named.
    let text = format!(
        "{HASH}in vec3 vPosition; void main() {{ vec4 c = texture(m, uv);\nif (c.a > hash(vPosition)) discard; }}"
    );
    let error = glsl(&text, &options(&[])).unwrap_err();
    assert!(error.contains("own.glsl:3:") && error.contains("exchange the two sides"), "{error}");
    // A hit of a ray is ignored, and a colour that is handed in is not the alpha of a texture.
    let ray = format!(
        "{HASH}void any(vec4 color, sampler2D t, vec3 pos) {{ vec4 k = texture(t, pos.xy) * color; if (k.a < hash(pos)) ignoreIntersectionEXT; }}"
    );
    assert_eq!(threshold(&glsl(&ray, &named("any")).unwrap(), AT), WANTED);
}
