//! What is refused: with which words, and at which place.

use super::*;

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
            "own.wgsl:3:3: `threshold` returns vec3<f32> here, where f32 is declared",
        ),
        (
            "fn other() -> f32 { return 1.0; }",
            "own.wgsl: there is no function `threshold`. --function NAME takes one of another name; functions are other; it",
        ),
        ("\n fn threshold() -> u32 { return 1u; }", "own.wgsl:2:2: `threshold` returns u32; it returns f32"),
        (
            "fn threshold(position: vec2<f32>) -> f32 { return 1.0; }",
            "parameter `position` of `threshold` is vec2<f32>",
        ),
        ("fn threshold(foo: f32) -> f32 { return foo; }", "--set foo=VALUE"),
        (
            "fn threshold(foo: vec4<f32>) -> f32 { return foo.x; }",
            "parameter `foo` of `threshold` has no value: --set foo=X,Y,Z,W; it",
        ),
        (
            "fn other() { discard; }\nfn threshold() -> f32 { other(); return 1.0; }",
            "own.wgsl:1:14: a threshold cannot `discard`",
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
        (
            "#version 330\nin vec3 v;\nin vec3 w;\nfloat threshold() { return v.x + w.x; }",
            "`v` is filled before `main` starts",
        ),
        (
            "float one() { return 1.0; }\nfloat bias = one();\nfloat threshold() { return bias; }",
            "`bias` is filled before `main` starts",
        ),
        (
            "uniform float foo;\nfloat threshold() { return foo; }",
            "uniform `foo` has no value: --set foo=VALUE",
        ),
        (
            "uniform vec3 foo;\nfloat threshold() { return foo.x; }",
            "own.glsl:1:14: uniform `foo` has no value: --set foo=X,Y,Z",
        ),
        (
            "uniform float foo[3];\nfloat threshold() { return foo[0]; }",
            "own.glsl:1:15: uniform `foo`, of type an array of f32, has no value, and --set gives one to numbers and vectors only",
        ),
        (
            "uniform sampler2D t;\nfloat threshold(vec3 position) { return texture(t, position.xy).a; }",
            "`t` is a texture, which is not there when the function runs alone: make what is read of it a parameter",
        ),
        (
            "float threshold(vec3 position) {\n  return position.x > 0.0 ? 0.5 : threshold(-position); }",
            "functions that call each other in a circle",
        ),
        (
            "#define S \"str\"\nfloat threshold() { return 1.0; }",
            "own.glsl:1:11: \"\\\"\" is no character of GLSL",
        ),
        (
            "#error \"don't\"\nfloat threshold() { return 1.0; }",
            "own.glsl:1:2: the file says: #error \"don't\"",
        ),
        (
            "uniform Camera { mat4 view; float lens[4]; } camera;\nfloat threshold() { return camera.lens[0]; }",
            "`lens` of uniform block `camera`, of type an array of f32, has no value, and --set gives one to numbers",
        ),
        ("float threshold(out float foo) { foo = 1.0; return 1.0; }", "a pointer (an `out` or `inout`)"),
        (
            "float threshold(float a) { return a; } float threshold(vec3 position) { return 1.0; }",
            "several functions",
        ),
    ] {
        let error = glsl(text, &none).expect_err(text);
        wrong.extend((!error.contains(wanted)).then(|| format!("{error}, not {wanted}")));
    }
    assert_eq!(wrong, Vec::<String>::new());
    let no_text = parse("own.wgsl", Language::Wgsl, b"fn \xff", &none).unwrap_err();
    assert_eq!(no_text.to_string(), "own.wgsl:1:4: the byte 0xff is not UTF-8");
    let latin = parse("own.glsl", Language::Glsl, b"\xef\xbb\xbf\n//\xc3\xa9 \xe9", &none).unwrap_err();
    assert_eq!(latin.to_string(), "own.glsl:2:5: the byte 0xe9 is not UTF-8");
    let words = parse("own.spv", Language::SpirV, &[1, 2, 3], &none).unwrap_err();
    assert!(words.to_string().starts_with("own.spv: "), "{words}");
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
        (
            "#include <common>\nfloat threshold() { return rand(1.0); }",
            "own.glsl:2:28: Unknown function 'rand'; `#include <common>` may have it, which is neither beside the file",
        ),
        (
            "#include <a>\nfloat threshold() { return PI; }",
            "own.glsl:2:28: `PI` has no value: it is declared nowhere",
        ),
        ("float threshold() { return 1.0; }\n/* open", "own.glsl:2:1: a comment that does not end"),
        ("float threshold() { return \u{0}1.0; }", "own.glsl:1:28: \"\\0\" is no character of GLSL"),
        ("float threshold() { return größe; }", "own.glsl:1:30: \"ö\" is no character of GLSL"),
        ("float threshold() {", "own.glsl:1:19: the file ends before this `{` is closed"),
    ] {
        let error = glsl(text, &options(&[])).unwrap_err();
        assert!(error.starts_with(wanted), "{error}, not {wanted}");
    }
    let main = Options { function: "main".to_owned(), ..Options::default() };
    let error = glsl("void main() {}", &main).unwrap_err();
    assert!(error.starts_with("own.glsl: `main` has no test of an alpha"), "{error}");
    let numbered = "@id(3) override foo: f32;\nfn threshold() -> f32 { return foo; }";
    assert!(
        wgsl(numbered, &options(&[])).unwrap_err().contains("override `foo` has no value: --set foo=VALUE")
    );
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

#[test]
fn messages_are_in_the_words_of_the_file() {
    let mut wrong = Vec::new();
    let mut is_said = |error: String, wanted: &str| {
        wrong.extend((!error.contains(wanted)).then(|| format!("{error}, not {wanted}")));
        for bad in ["see msg", "Semicolon", "Scalar(", "[0]", "[1]", "Expression"] {
            wrong.extend(error.contains(bad).then(|| format!("{error} has {bad}")));
        }
    };
    for (text, wanted) in [
        (
            "fn threshold(p: vec3<f32>) -> f32 {\n  let x = 1;\n",
            "own.wgsl:1:35: the file ends before this `{` is closed",
        ),
        (
            "fn threshold() -> f32 { return foo; }",
            "own.wgsl:1:32: no definition in scope for identifier: `foo`",
        ),
        ("const a = 1u / 0u;\nfn threshold() -> f32 { return f32(a); }", "own.wgsl:1:11: "),
        (
            "fn threshold(lod: f32) -> f32 { return lod + 1u; }",
            "own.wgsl:1:40: `+` does not take f32 and u32",
        ),
        (
            "fn f(x: f32) -> f32 { return x; }\nfn threshold(frame: u32) -> f32 { return f(frame); }",
            "own.wgsl:2:42: argument 1 of `f` is u32, not f32",
        ),
        (
            "fn threshold(lod: f32) -> f32 { if lod { return 1.0; } return 0.5; }",
            "own.wgsl:1:33: a condition is a bool; this is f32",
        ),
    ] {
        is_said(wgsl(text, &options(&[])).unwrap_err(), wanted);
    }
    for (text, wanted) in [
        (
            "float threshold() {\n  float x = 1.0\n  return x;\n}",
            "own.glsl:3:3: expected `,` or `;`, found `return`",
        ),
        (
            "#ifdef A\n#else\nfloat threshold() { return 1.0; }\n",
            "own.glsl:1:1: the file ends before this `#ifdef` has its `#endif`",
        ),
        ("float threshold() { return 1.0; }\n#endif", "own.glsl:2:1: `#endif` without an `#if` before it"),
        (
            "float threshold(vec3 position) { float x = position; return x; }",
            "own.glsl:1:40: a value of type vec3<f32> cannot become a f32",
        ),
        (
            "#define A B + 1.0\n#define B A + 1.0\nfloat threshold() { return A; }",
            "`A` is left over here: the macro of that name in line 1 comes back to itself",
        ),
        (
            "float threshold() {\n  return fract(vThing.x); }",
            "own.glsl:2:16: `vThing` has no value: it is declared nowhere",
        ),
        (
            "vec3 glow;\nfloat other() { return glow.x; }\nfloat threshold() { return other(); }",
            "own.glsl:1:6: `glow` has no value: nothing that `threshold` comes to writes it",
        ),
        (
            "float f(float x);\nfloat g(float x) { return f(x); }\nfloat f(float x) { return g(x); }
float threshold(vec3 position) { return f(position.x); }",
            "functions that call each other in a circle",
        ),
        (
            "#version 450\nfloat threshold(vec3 position) {\n  double d = double(position.x); return float(d); }",
            "own.glsl:3:3: numbers of 16 or 64 bits are not taken; use 32 bits",
        ),
        (
            "float threshold(vec3 position) { float x = position.x; }",
            "own.glsl:1:1: `threshold` returns nothing here",
        ),
        ("#error it needs more\nfloat threshold() { return 1.0; }", "#error it needs more"),
    ] {
        is_said(glsl(text, &options(&[])).unwrap_err(), wanted);
    }
    let uniform = "\nuniform float k;\nfloat threshold() { return k; }";
    is_said(glsl(uniform, &options(&[("k", "abc")])).unwrap_err(), "own.glsl:2:15: `k`: `abc` is no f32");
    assert_eq!(wrong, Vec::<String>::new());
}

#[test]
fn a_function_that_is_not_there_is_looked_for_first() {
    let text = "#ifdef USE_ALPHAHASH
float other(vec3 p) { return length(dFdx(p.xy)); }
float threshold(vec3 position) { return other(position); }
#endif
float third() { return 1.0; }";
    let defined = glsl(text, &options(&[])).unwrap();
    assert_eq!(defined.notes, ["`USE_ALPHAHASH` is defined as 1, since `threshold` stands behind it"]);
    let of_another =
        text.replace("#ifdef USE_ALPHAHASH", "#if VERSION < 3").replace("#endif", "#else\n#endif");
    let error = glsl(&of_another, &options(&[("VERSION", "4")])).unwrap_err();
    assert!(
        error.contains("there is no function `threshold` here: it stands behind `#if VERSION < 3`"),
        "{error}"
    );
    let mine = Options { function: "mine".to_owned(), ..Options::default() };
    let error = glsl(text, &mine).unwrap_err();
    let listed = "functions are other (behind `#ifdef USE_ALPHAHASH`), third, threshold (behind `#ifdef USE_ALPHAHASH`);";
    assert!(error.contains("--function NAME") && error.contains(listed), "{error}");
    let near = Options { function: "thrid".to_owned(), ..Options::default() };
    assert!(glsl(text, &near).unwrap_err().contains("there is no function `thrid`. Did you mean `third`?"));
    let error = wgsl("fn a(p: vec3<f32>) -> f32 { return dpdx(p.x); }", &mine).unwrap_err();
    assert!(error.contains("functions are a;"), "{error}");
    // Behind its condition it is read, and what it comes to counts.
    let text = text.replace("p.xy", "q.xy");
    let error = glsl(&text, &options(&[("USE_ALPHAHASH", "1")])).unwrap_err();
    assert!(error.contains("own.glsl:2:") && error.contains("`q` has no value"), "{error}");
}
