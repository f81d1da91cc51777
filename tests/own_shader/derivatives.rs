//! Derivatives of anything: each is the difference to the neighbouring pixel.

use super::*;

/// The value of a function at a position, and what the file's own derivative along an axis makes of it.
fn tried(before: &str, value: &str, position: [f64; 3]) -> [(f32, f32); 2] {
    let run = |returned: &str, position: [f64; 3]| {
        let text = format!("{before}\nfloat threshold(vec3 position) {{ {returned} }}");
        let shader = glsl(&text, &options(&[])).unwrap_or_else(|error| panic!("{error}\n{text}"));
        threshold(&shader, position)
    };
    let plain = format!("return {value};");
    let here = run(&plain, position);
    [("dFdx", [0.125, 0.0, 0.0]), ("dFdy", [0.0, 0.25, 0.0])].map(|(derivative, step)| {
        let there = run(&plain, [0, 1, 2].map(|axis| position[axis] + step[axis]));
        (run(&format!("return {derivative}({value});"), position), there - here)
    })
}

#[test]
fn a_derivative_is_the_difference_to_the_next_pixel() {
    let position = [0.375, 0.5, 0.75];
    for (before, value) in [
        ("", "position.x"),
        ("", "length(position)"),
        ("", "dot(position, position.zxy)"),
        ("", "(position * 8.0).y - position.x / (1.0 + position.y)"),
        ("", "mod(position.y * 5.0, 1.5) + -position.x"),
        ("", "floor(position.x * 8.0) + sin(position.y) * pow(position.x, 3.0)"),
        ("", "vec4(position.yx, 1.0, position.x).w * mix(2.0, 3.0, position.y)"),
        ("", "(mat2(position.x, 0.0, 1.0, position.y) * position.xy).y"),
        ("", "float(int(position.y)) + (position.z > 0.5 ? position.x : 1.0)"),
        ("#define P position\n#define Q(v) (v * v)", "Q(P.x)"),
        ("float g(vec3 p) { return p.x * p.y; }", "g(position) + g(position.yxz * 2.0)"),
        ("float g(vec3 p) { vec3 q = p; q.x += 1.0; q *= q; return q.x + q.y; }", "g(position)"),
        (
            "void g(inout float x, out vec2 y) { x *= 2.0; y = vec2(x, 1.0); }
          float h(vec3 p) { float x = p.x; vec2 y; g(x, y); return x + y.x * y.x; }",
            "h(position)",
        ),
        (
            "struct S { float a; int b; vec2 c; };
          S s(vec3 p) { S s; s.a = p.x; s.b = int(p.y); s.c = p.yx; return s; }
          float h(vec3 p) { S t = s(p); return t.a * t.c.x; }",
            "h(position)",
        ),
        (
            "float g(vec3 p) { float sum = 0.0; for (int i = 0; i < 5; ++i) { if (i == 3) continue; sum += p.x * float(i); } return sum; }",
            "g(position)",
        ),
        (
            "float g(vec3 p) { float a[3]; for (int i = 0; i < 3; ++i) a[i] = p[i] * 2.0; return a[1] + a[0] * a[0]; }",
            "g(position)",
        ),
        (
            "float kept; void g(vec3 p) { kept = p.x * 3.0; } float h(vec3 p) { g(p); return kept; }",
            "h(position)",
        ),
        (
            "float g(vec3 p) { switch (int(p.z * 4.0)) { case 3: return p.x; default: return p.y; } }",
            "g(position)",
        ),
    ] {
        for (found, wanted) in tried(before, value, position) {
            assert!((found - wanted).abs() <= 2e-6, "{value} after {before}: {found}, not {wanted}");
        }
    }
}

/// What is linear keeps its difference where the positions of two pixels round to one.
#[test]
fn differences_of_the_linear_are_exact_far_from_the_origin() {
    let text = "float g(vec3 p) { return dFdx(p * 8.0 - p.yxz).x + length(dFdy(p)); }
        float threshold(vec3 position) { vec3 moved = position + vec3(3.0); return g(moved); }";
    let shader = glsl(text, &options(&[])).unwrap();
    for position in [[0.1, 0.2, 0.3], [1.0e8, -3.0e9, 7.0e12]] {
        assert_eq!(threshold(&shader, position), 1.25);
    }
}

#[test]
fn derivatives_are_taken_as_other_people_write_them() {
    for text in [
        "#define DX(v) dFdx(v)\nfloat threshold(vec3 position) { return length(DX(position)); }",
        "#define P position\nfloat threshold(vec3 position) { return length(dFdx(P)); }",
        "float g(vec3 p) { return length(dFdx(p)); } float threshold(vec3 position) { return g(position); }",
        "float threshold(vec3 position) { vec3 p = position; return length(dFdx(p)); }",
        "float threshold(vec3 position) { return dFdx(position * 8.0).x / 8.0; }",
        "in vec3 vPos; float g() { return fwidth(vPos.x); } float threshold() { return g(); }",
        "float threshold(vec3 position) { return 0.125 * dFdx(gl_FragCoord.x) + dFdy(gl_FragCoord.x); }",
        "float threshold(vec3 pos) { vec3 a = pos; return length(vec2(length(dFdx(a)), 0.0)); }",
    ] {
        let shader = glsl(text, &options(&[])).unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(threshold(&shader, [0.375, 0.5, 0.75]), 0.125, "{text}");
        assert!(shader.wgsl().is_ok());
    }
    let text = "fn g(p: ptr<function, vec3f>) -> f32 { return dpdx(*p).x; }
        fn threshold(position: vec3f) -> f32 { var p = position; let d = g(&p); p = p + vec3f(1.0); return d; }";
    let shader = wgsl(text, &options(&[])).unwrap();
    assert_eq!(threshold(&shader, [0.375, 0.5, 0.75]), 0.125);
}

#[test]
fn a_position_that_is_changed_has_another_derivative() {
    for changed in [
        "position *= 4.0;",
        "position = position * 4.0;",
        "position.x *= 4.0;",
        "grow(position);",
        "position[0] *= 4.0;",
    ] {
        let text = format!(
            "void grow(inout vec3 p) {{ p *= 4.0; }} float threshold(vec3 position) {{ {changed} return dFdx(position.x); }}"
        );
        let shader = glsl(&text, &options(&[])).unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(threshold(&shader, [0.375, 0.5, 0.75]), 0.5, "{text}");
    }
}

/// The short way by names and the long way by types take one thing for the position.
#[test]
fn what_has_a_value_or_another_meaning_has_no_derivative_of_the_position() {
    let text = "float threshold(vec3 pos) { return length(dFdx(pos)) + 0.5; }";
    assert_eq!(threshold(&glsl(text, &options(&[("pos", "1,2,3")])).unwrap(), [0.375, 0.5, 0.75]), 0.5);
    let map = |value: &str, name: &str| Options {
        map: [(value.to_owned(), name.to_owned())].into(),
        ..Options::default()
    };
    let text = "float threshold(vec4 where) { return length(dFdx(where)) + dFdx(where.xyz).x; }";
    assert_eq!(threshold(&glsl(text, &map("position", "where")).unwrap(), [0.375, 0.5, 0.75]), 0.25);
    let text = "float threshold(vec3 pos, vec3 q) { return dFdx(q).x + 0.0 * pos.x; }";
    let asked = Options { settings: [("pos".to_owned(), "0,0,0".to_owned())].into(), ..map("position", "q") };
    assert_eq!(threshold(&glsl(text, &asked).unwrap(), [0.375, 0.5, 0.75]), 0.125);
}
