//! Every group of operations against values worked out by hand, and what is refused.

use hashed_alpha::shader::interpreter::{
    Column, DeviceModel, Kind, Parameter, Program, Undefined, UndefinedKind, Unsupported, Values,
};

fn compile(source: &str) -> Result<Program, Unsupported> {
    let module =
        naga::front::wgsl::parse_str(source).unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    let info = naga::valid::Validator::new(Default::default(), naga::valid::Capabilities::all())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
    Program::compile(&module, &info, "f")
}

/// Runs a function `f` that returns a `u32`.
fn run(source: &str, columns: &[Column<'_>], lanes: usize) -> Vec<u32> {
    let program = compile(source).unwrap_or_else(|e| panic!("{}", e.in_source(source)));
    let results = program.run(columns, lanes, &DeviceModel::ACCURATE);
    let results = results.unwrap_or_else(|e| panic!("{}", e.in_source(source)));
    let [Values::U32(words)] = &results[..] else { panic!("{results:?}") };
    words.clone()
}

/// Evaluates an expression of a, b, c (f32), i, j, k (i32), u, v, w (u32); its value is to be a `u32`.
fn evaluate(expression: &str, floats: [f32; 3], signed: [i32; 3], words: [u32; 3]) -> u32 {
    let source = format!(
        "fn f(a: f32, b: f32, c: f32, i: i32, j: i32, k: i32, u: u32, v: u32, w: u32) -> u32 {{
            return {expression};
        }}"
    );
    let mut columns = Vec::new();
    columns.extend(floats.iter().map(|value| Column::F32(core::slice::from_ref(value))));
    columns.extend(signed.iter().map(|value| Column::I32(core::slice::from_ref(value))));
    columns.extend(words.iter().map(|value| Column::U32(core::slice::from_ref(value))));
    run(&source, &columns, 1)[0]
}

fn float(expression: &str, arguments: [f32; 3]) -> f32 {
    f32::from_bits(evaluate(&format!("bitcast<u32>({expression})"), arguments, [1, -1, 2], [1, 2, 3]))
}

fn signed(expression: &str, arguments: [i32; 3]) -> i32 {
    evaluate(&format!("bitcast<u32>({expression})"), [1.0, 2.0, 3.0], arguments, [1, 2, 3]) as i32
}

fn word(expression: &str, arguments: [u32; 3]) -> u32 {
    evaluate(expression, [1.0, 2.0, 3.0], [1, -1, 2], arguments)
}

fn truth(expression: &str, arguments: [f32; 3]) -> bool {
    evaluate(&format!("select(0u, 1u, {expression})"), arguments, [1, -1, 2], [1, 2, 3]) == 1
}

/// Compares bits, so that the sign of zero counts; any NaN is NaN.
fn floats(table: &[(&str, [f32; 3], f32)]) {
    for &(expression, arguments, expected) in table {
        let value = float(expression, arguments);
        let same = value.to_bits() == expected.to_bits() || (value.is_nan() && expected.is_nan());
        assert!(same, "{expression} of {arguments:?} is {value:e}, not {expected:e}");
    }
}

const NAN: f32 = f32::NAN;
const INF: f32 = f32::INFINITY;

#[test]
fn float_arithmetic_and_rounding() {
    floats(&[
        ("a + b", [0.1, 0.2, 0.0], 0.1 + 0.2),
        ("a - b", [1.0, 1.0e-8, 0.0], 1.0),
        ("a / b", [1.0, 0.0, 0.0], INF),
        ("-a", [0.0, 0.0, 0.0], -0.0),
        ("a % b", [5.5, 2.0, 0.0], 1.5),
        ("a % b", [-5.5, 2.0, 0.0], -1.5),
        ("abs(a)", [-2.5, 0.0, 0.0], 2.5),
        ("floor(a)", [-0.5, 0.0, 0.0], -1.0),
        ("ceil(a)", [-0.5, 0.0, 0.0], -0.0),
        ("round(a)", [2.5, 0.0, 0.0], 2.0),
        ("round(a)", [3.5, 0.0, 0.0], 4.0),
        ("trunc(a)", [-2.7, 0.0, 0.0], -2.0),
        ("fract(a)", [-0.25, 0.0, 0.0], 0.75),
        ("fract(a)", [-1.0e-9, 0.0, 0.0], 1.0),
        ("sign(a)", [-3.0, 0.0, 0.0], -1.0),
        ("sign(a)", [0.0, 0.0, 0.0], 0.0),
        ("saturate(a)", [1.5, 0.0, 0.0], 1.0),
        ("sqrt(a)", [2.0, 0.0, 0.0], core::f32::consts::SQRT_2),
        ("inverseSqrt(a)", [4.0, 0.0, 0.0], 0.5),
        ("fma(a, b, c)", [1.000_000_1, 1.000_000_1, -1.000_000_2], 1.421_085_5e-14),
        ("mix(a, b, c)", [2.0, 6.0, 0.25], 3.0),
        ("step(a, b)", [2.0, 2.0, 0.0], 1.0),
        ("step(a, b)", [2.0, 1.0, 0.0], 0.0),
        ("smoothstep(a, b, c)", [0.0, 2.0, 0.5], 0.15625),
        ("degrees(a)", [core::f32::consts::PI, 0.0, 0.0], 180.0),
        ("radians(a)", [180.0, 0.0, 0.0], core::f32::consts::PI),
        ("quantizeToF16(a)", [0.1, 0.0, 0.0], 0.099_975_586),
        ("modf(a).fract", [-1.25, 0.0, 0.0], -0.25),
        ("modf(a).whole", [-1.25, 0.0, 0.0], -1.0),
        ("frexp(a).fract", [-12.0, 0.0, 0.0], -0.75),
        ("f32(frexp(a).exp)", [-12.0, 0.0, 0.0], 4.0),
        ("ldexp(a, k)", [-0.75, 0.0, 0.0], -3.0),
    ]);
}

#[test]
fn min_max_and_clamp_keep_the_first_nan() {
    floats(&[
        ("min(a, b)", [NAN, 1.0, 0.0], NAN),
        ("min(a, b)", [1.0, NAN, 0.0], 1.0),
        ("max(a, b)", [NAN, 1.0, 0.0], NAN),
        ("max(a, b)", [1.0, NAN, 0.0], 1.0),
        ("clamp(a, b, c)", [NAN, 0.0, 1.0], NAN),
        ("clamp(a, b, c)", [-3.0, 1.0e-6, 1.0], 1.0e-6),
        ("clamp(a, b, c)", [3.0, 1.0e-6, 1.0], 1.0),
    ]);
    assert!(!truth("a < b", [NAN, 1.0, 0.0]) && !truth("a >= b", [NAN, 1.0, 0.0]));
    assert!(truth("a != a", [NAN, 0.0, 0.0]) && !truth("a == a", [NAN, 0.0, 0.0]));
    assert!(truth("a > b", [2.0, 1.0, 0.0]) && truth("a <= b", [1.0, 1.0, 0.0]));
}

#[test]
fn transcendentals_are_rounded_from_f64() {
    floats(&[
        ("sin(a)", [1.0, 0.0, 0.0], 0.841_470_984_807_896_5),
        ("sin(a)", [-0.0, 0.0, 0.0], -0.0),
        ("cos(a)", [1.0, 0.0, 0.0], 0.540_302_305_868_139_8),
        ("tan(a)", [0.0, 0.0, 0.0], 0.0),
        ("asin(a)", [1.0, 0.0, 0.0], core::f32::consts::FRAC_PI_2),
        ("acos(a)", [2.0, 0.0, 0.0], NAN),
        ("atan(a)", [1.0, 0.0, 0.0], core::f32::consts::FRAC_PI_4),
        ("atan2(a, b)", [1.0, -1.0, 0.0], 2.356_194_490_192_345),
        ("sinh(a)", [1.0, 0.0, 0.0], 1.175_201_193_643_801_4),
        ("cosh(a)", [1.0, 0.0, 0.0], 1.543_080_634_815_243_8),
        ("tanh(a)", [1.0, 0.0, 0.0], 0.761_594_155_955_764_9),
        ("asinh(a)", [1.0, 0.0, 0.0], 0.881_373_587_019_543),
        ("acosh(a)", [2.0, 0.0, 0.0], 1.316_957_896_924_816_6),
        ("atanh(a)", [0.5, 0.0, 0.0], 0.549_306_144_334_054_8),
        ("exp(a)", [1.0, 0.0, 0.0], core::f32::consts::E),
        ("exp2(a)", [-149.0, 0.0, 0.0], f32::from_bits(1)),
        ("log(a)", [0.0, 0.0, 0.0], -INF),
        ("log2(a)", [8.0, 0.0, 0.0], 3.0),
        ("pow(a, b)", [2.0, 0.5, 0.0], core::f32::consts::SQRT_2),
        ("pow(a, b)", [-2.0, 2.0, 0.0], NAN),
    ]);
}

#[test]
fn vectors_and_matrices() {
    floats(&[
        ("dot(vec3f(a, b, c), vec3f(c, a, b))", [1.0, 2.0, 3.0], 11.0),
        ("length(vec2f(a, b))", [3.0, 4.0, 0.0], 5.0),
        ("distance(vec2f(a, b), vec2f(c))", [4.0, 5.0, 1.0], 5.0),
        ("distance(a, b)", [4.0, 5.0, 1.0], 1.0),
        ("normalize(vec2f(a, b)).y", [3.0, 4.0, 0.0], 0.8),
        ("cross(vec3f(a, b, c), vec3f(c, a, b)).x", [1.0, 2.0, 3.0], 1.0),
        ("reflect(vec2f(a, b), vec2f(c, 0.0)).x", [3.0, 4.0, 1.0], -3.0),
        ("refract(vec2f(a, b), vec2f(0.0, 1.0), c).y", [0.0, -1.0, 0.5], -1.0),
        ("refract(vec2f(a, b), vec2f(0.0, 1.0), c).x", [0.8, -0.6, 2.0], 0.0),
        ("faceForward(vec2f(a, b), vec2f(c, 0.0), vec2f(1.0, 0.0)).x", [3.0, 4.0, 1.0], -3.0),
        ("(2.0 * vec3f(a, b, c).zyx).x", [1.0, 2.0, 3.0], 6.0),
        ("(vec2f(a, b) / c).y", [1.0, 2.0, 4.0], 0.5),
        ("mix(vec2f(a), vec2f(b), c).y", [0.0, 8.0, 0.5], 4.0),
        ("vec3f(a, b, c)[u]", [1.0, 2.0, 3.0], 2.0),
        ("vec3f(a, b, c)[j]", [1.0, 2.0, 3.0], 3.0),
        // Columns (a, b) and (c, 1).
        ("(mat2x2f(a, b, c, 1.0) * vec2f(1.0, 10.0)).x", [2.0, 3.0, 5.0], 52.0),
        ("(vec2f(1.0, 10.0) * mat2x2f(a, b, c, 1.0)).x", [2.0, 3.0, 5.0], 32.0),
        ("(mat2x2f(a, b, c, 1.0) * mat2x2f(1.0, 1.0, 0.0, 2.0))[0].y", [2.0, 3.0, 5.0], 4.0),
        ("(mat2x2f(a, b, c, 1.0) * mat2x2f(1.0, 1.0, 0.0, 2.0))[1].x", [2.0, 3.0, 5.0], 10.0),
        ("(mat2x2f(a, b, c, 1.0) + mat2x2f(1.0, 1.0, 1.0, 1.0))[1].y", [2.0, 3.0, 5.0], 2.0),
        ("(3.0 * mat2x2f(a, b, c, 1.0))[0].y", [2.0, 3.0, 5.0], 9.0),
        ("transpose(mat3x2f(a, b, c, 1.0, 7.0, 9.0))[1].y", [2.0, 3.0, 5.0], 1.0),
        ("(mat3x2f(a, b, c, 1.0, 7.0, 9.0) * vec3f(1.0, 0.0, 1.0)).y", [2.0, 3.0, 5.0], 12.0),
        ("determinant(mat2x2f(a, b, c, 1.0))", [2.0, 3.0, 5.0], -13.0),
        ("determinant(mat3x3f(a, 0.0, 0.0, 0.0, b, 1.0, 0.0, 1.0, c))", [2.0, 3.0, 5.0], 28.0),
        (
            "determinant(mat4x4f(a, 0.0, 0.0, 0.0, 0.0, b, 0.0, 0.0, 0.0, 0.0, c, 1.0, 0.0, 0.0, 2.0, 1.0))",
            [2.0, 3.0, 5.0],
            18.0,
        ),
    ]);
    assert!(truth("all(vec2f(a, b) < vec2f(c))", [1.0, 2.0, 3.0]));
    assert!(!truth("all(vec2f(a, b) < vec2f(c))", [1.0, 4.0, 3.0]));
    assert!(truth("any(vec2f(a, b) > vec2f(c))", [1.0, 4.0, 3.0]));
    assert!(truth("select(vec2<bool>(true), vec2<bool>(false), vec2f(a, b) > vec2f(c)).x", [1.0, 4.0, 3.0]));
}

#[test]
fn conversions_saturate_and_bits_are_kept() {
    let to_signed = |x: f32| evaluate("bitcast<u32>(i32(a))", [x, 0.0, 0.0], [0; 3], [0; 3]) as i32;
    let to_unsigned = |x: f32| evaluate("u32(a)", [x, 0.0, 0.0], [0; 3], [0; 3]);
    assert_eq!([-2.9, 3.0e9, -INF, NAN].map(to_signed), [-2, i32::MAX, i32::MIN, 0]);
    assert_eq!([2.9, -1.0, 5.0e9, NAN].map(to_unsigned), [2, 0, u32::MAX, 0]);
    assert_eq!(signed("bitcast<i32>(f32(i))", [16_777_217, 0, 0]), 0x4b80_0000);
    assert_eq!(word("bitcast<u32>(f32(u))", [u32::MAX, 0, 0]), 0x4f80_0000);
    assert_eq!(signed("i32(u32(i))", [-7, 0, 0]), -7);
    assert_eq!(word("u32(bool(u)) + u32(bool(v))", [7, 0, 0]), 1);
    assert_eq!(word("bitcast<u32>(f32(u > v))", [7, 0, 0]), 0x3f80_0000);
    assert_eq!(word("select(0u, 1u, bool(bitcast<f32>(u)))", [0x8000_0000, 0, 0]), 0, "minus zero is false");
}

#[test]
fn integers_wrap_and_division_by_zero_is_defined() {
    for (expression, arguments, expected) in [
        ("i + j", [i32::MAX, 1, 0], i32::MIN),
        ("i * j", [i32::MIN, -1, 0], i32::MIN),
        ("-i", [i32::MIN, 0, 0], i32::MIN),
        ("i / j", [-7, 2, 0], -3),
        ("i / j", [-7, 0, 0], -7),
        ("i / j", [i32::MIN, -1, 0], i32::MIN),
        ("i % j", [-7, 2, 0], -1),
        ("i % j", [-7, 0, 0], 0),
        ("i % j", [i32::MIN, -1, 0], 0),
        ("abs(i)", [i32::MIN, 0, 0], i32::MIN),
        ("sign(i)", [-9, 0, 0], -1),
        ("min(i, j)", [-1, 1, 0], -1),
        ("max(i, j)", [-1, 1, 0], 1),
        ("clamp(i, j, k)", [-5, -2, 2], -2),
        ("i >> u32(j)", [-8, 33, 0], -4),
        ("i << u32(j)", [3, 33, 0], 6),
        ("~i", [5, 0, 0], -6),
        ("dot(vec2i(i, j), vec2i(k, 1))", [3, 4, 5], 19),
        ("select(i, j, i < j)", [-1, 1, 0], 1),
        ("select(i, j, i >= j)", [-1, 1, 0], -1),
        ("firstLeadingBit(i)", [-2, 0, 0], 0),
        ("firstLeadingBit(i)", [-1, 0, 0], -1),
        ("extractBits(i, 4u, 4u)", [0xf0, 0, 0], -1),
        ("extractBits(i, 40u, 4u)", [0xf0, 0, 0], 0),
        ("dot4I8Packed(u32(i), u32(j))", [0x0100_00ff, 0x0200_0003, 0], -1),
    ] {
        assert_eq!(signed(expression, arguments), expected, "{expression} of {arguments:?}");
    }
    for (expression, arguments, expected) in [
        ("u - v", [1, 2, 0], u32::MAX),
        ("u * v", [0x8000_0001, 2, 0], 2),
        ("u / v", [7, 0, 0], 7),
        ("u % v", [7, 0, 0], 0),
        ("u >> v", [0x8000_0000, 31, 0], 1),
        ("(u ^ v) | (w & 1u)", [6, 3, 3], 5),
        ("u32(u < v) + 2u * u32(u > v)", [1, 0xffff_ffff, 0], 1),
        ("countOneBits(u)", [0xf0f0, 0, 0], 8),
        ("countLeadingZeros(u)", [0, 0, 0], 32),
        ("countTrailingZeros(u)", [8, 0, 0], 3),
        ("reverseBits(u)", [1, 0, 0], 0x8000_0000),
        ("firstTrailingBit(u)", [0, 0, 0], u32::MAX),
        ("firstTrailingBit(u)", [12, 0, 0], 2),
        ("firstLeadingBit(u)", [12, 0, 0], 3),
        ("firstLeadingBit(u)", [0, 0, 0], u32::MAX),
        ("extractBits(u, v, w)", [0x1234_5678, 8, 12], 0x456),
        ("extractBits(u, v, w)", [0x1234_5678, 28, 12], 1),
        ("extractBits(u, v, w)", [0x1234_5678, 0, 32], 0x1234_5678),
        ("extractBits(u, v, w)", [0x1234_5678, 3, 0], 0),
        ("insertBits(u, v, w, 8u)", [0x1234_5678, 0xab, 16], 0x12ab_5678),
        ("insertBits(u, v, w, 0u)", [0x1234_5678, 0xab, 16], 0x1234_5678),
        ("insertBits(u, v, w, 32u)", [0x1234_5678, 0xab, 0], 0xab),
        ("pack4x8snorm(vec4f(-1.0, 1.0, 0.5, f32(u)))", [0, 0, 0], 0x0040_7f81),
        ("pack4x8unorm(vec4f(1.0, 0.5, 0.0, f32(u)))", [2, 0, 0], 0xff00_80ff),
        ("pack2x16snorm(vec2f(-1.0, f32(u)))", [1, 0, 0], 0x7fff_8001),
        ("pack2x16unorm(vec2f(1.0, f32(u)))", [0, 0, 0], 0x0000_ffff),
        ("pack2x16float(vec2f(1.0, f32(u)))", [2, 0, 0], 0x4000_3c00),
        ("pack4xU8(vec4u(u, v, w, 260u))", [1, 2, 3], 0x0403_0201),
        ("pack4xU8Clamp(vec4u(u, v, w, 260u))", [1, 2, 3], 0xff03_0201),
        ("bitcast<u32>(unpack4x8snorm(u).y)", [0x0000_8000, 0, 0], 0xbf80_0000),
        ("bitcast<u32>(unpack4x8unorm(u).w)", [0xff00_0000, 0, 0], 0x3f80_0000),
        ("bitcast<u32>(unpack2x16snorm(u).x)", [0x7fff, 0, 0], 0x3f80_0000),
        ("bitcast<u32>(unpack2x16unorm(u).y)", [0, 0, 0], 0),
        ("bitcast<u32>(unpack2x16float(u).y)", [0xc000_0000, 0, 0], 0xc000_0000),
        ("bitcast<u32>(unpack4xI8(u).x)", [0xff, 0, 0], u32::MAX),
        ("unpack4xU8(u).z", [0x00ab_0000, 0, 0], 0xab),
        ("dot4U8Packed(u, v)", [0x0102_0304, 0x0101_0101, 0], 10),
    ] {
        assert_eq!(word(expression, arguments), expected, "{expression} of {arguments:x?}");
    }
}

#[test]
fn composites_pointers_and_module_variables() {
    let source = "
        struct Inner { v: vec2u, n: u32 }
        struct Outer { parts: array<Inner, 3>, last: u32 }
        const offset = 100u;
        override scale: u32 = 2u * 3u;
        override twice = scale * 2u;
        var<private> calls: u32;
        var<private> seeds: array<u32, 2> = array<u32, 2>(7u, 9u);

        fn bump(p: ptr<function, u32>, by: u32) { *p += by; calls++; }
        fn second(p: ptr<function, Outer>, i: u32) -> u32 { return (*p).parts[i].v.y; }

        fn f(i: u32) -> u32 {
            var o: Outer;
            o.parts[1].v = vec2u(10u, 20u);
            o.parts[i].n = 5u;
            o.parts[2].v[i - i + 1u] = 30u;
            bump(&o.last, 1u);
            let p = &o.parts[i];
            bump(&(*p).n, i);
            var copy = o;
            copy.last = 1000u;
            let third = copy.parts[2].v;
            return o.last + o.parts[i].n * 10u + second(&o, i) * 1000u + calls * 100000u
                + seeds[i] * 1000000u + offset + scale + twice + third.y * 100000000u;
        }";
    let expected = |i: u32| {
        let k = i.min(2);
        1 + (5 + i) * 10
            + [0, 20, 30][k as usize] * 1000
            + 200_000
            + [7, 9, 9][k as usize] * 1_000_000
            + 118
            + 3_000_000_000_u32
    };
    let lanes = [0, 1, 2, 3, 9];
    assert_eq!(run(source, &[Column::U32(&lanes)], 5), lanes.map(expected));
}

/// Lanes take every way through loops, switches and calls that return early; three blocks of lanes and a bit.
#[test]
fn lanes_part_and_meet_as_each_would_alone() {
    let source = "
        fn early(x: u32) -> u32 {
            for (var i = 0u; i < 10u; i++) {
                if i * i > x { return i; }
                if x == 50u { break; }
            }
            return 77u;
        }
        fn f(x: u32) -> u32 {
            var sum = 0u;
            outer: for (var i = 0u; i < x % 13u; i++) {
                if i == 3u { continue; }
                var j = 0u;
                loop {
                    if (i ^ j) % 7u == 5u { break; }
                    j++;
                    if j % 3u == x % 3u { continue; }
                    sum += i * 10u + j;
                    switch (sum + x) % 5u {
                        case 0u: { sum += 1u; }
                        case 1u, 2u: { if x % 2u == 0u { break; } sum += 3u; }
                        case 3u: { continue; }
                        default: { if sum > 5000u { return sum; } sum += early(sum % 60u); }
                    }
                    continuing {
                        sum ^= 1u;
                        break if j >= x % 11u;
                    }
                }
                while sum % 4u != 0u { sum += 1u; }
            }
            return sum;
        }"
    .replace("outer: ", "");
    fn early(x: u32) -> u32 {
        for i in 0..10 {
            if i * i > x {
                return i;
            }
            if x == 50 {
                break;
            }
        }
        77
    }
    fn alone(x: u32) -> u32 {
        let mut sum = 0_u32;
        for i in 0..x % 13 {
            if i == 3 {
                continue;
            }
            let mut j = 0;
            loop {
                if (i ^ j) % 7 == 5 {
                    break;
                }
                j += 1;
                if j % 3 != x % 3 {
                    sum += i * 10 + j;
                    match (sum + x) % 5 {
                        0 => sum += 1,
                        1 | 2 if x.is_multiple_of(2) => {}
                        1 | 2 => sum += 3,
                        3 => {}
                        _ if sum > 5000 => return sum,
                        _ => sum += early(sum % 60),
                    }
                }
                sum ^= 1;
                if j >= x % 11 {
                    break;
                }
            }
            while !sum.is_multiple_of(4) {
                sum += 1;
            }
        }
        sum
    }
    let lanes: Vec<u32> = (0..400).collect();
    let expected: Vec<u32> = lanes.iter().map(|&x| alone(x)).collect();
    assert_eq!(run(&source, &[Column::U32(&lanes)], lanes.len()), expected);
}

#[test]
fn a_loop_that_does_not_end_is_stopped_and_named() {
    let source = "fn f(n: u32) -> u32 {
    var x = n;
    for (var i = 0u; i < 3u; i++) { x += i; }
    loop {
        x += 1u;
        for (var i = 0u; i < 3u; i++) { x += i; }
        if x == 5u { break; }
        x |= 8u;
    }
    return x;
}";
    let mut program = compile(source).expect("it is interpreted");
    program.steps = 100_000;
    let lanes: Vec<u32> = (0..1000).collect();
    let stopped =
        program.run(&[Column::U32(&lanes)], 1000, &DeviceModel::ACCURATE).expect_err("it does not end");
    assert_eq!(
        stopped.in_source(source),
        "line 4, column 5: a loop does not end, or takes more than 100000 steps"
    );
    // The loop that ends where there is only that one.
    let ends = "fn f(n: u32) -> u32 { var x = n; loop { x += 1u; if x > 1000u { break; } } return x; }";
    assert_eq!(run(ends, &[Column::U32(&[0])], 1), [1001]);
}

#[test]
fn what_is_not_interpreted_is_refused_with_its_place() {
    for (source, line, words) in [
        (
            "@group(0) @binding(0) var<uniform> size: f32;\nfn f() -> f32 { return size; }",
            2,
            "uniform buffer",
        ),
        (
            "@group(0) @binding(0) var t: texture_2d<f32>;\nfn f() -> f32 {\n return textureLoad(t, vec2i(), 0).x; }",
            3,
            "texture",
        ),
        ("fn f(x: f32) -> f32 {\n return dpdx(x); }", 2, "derivatives"),
        ("fn f(x: f32) -> f32 {\n if x > 1.0 {\n  discard; }\n return x; }", 3, "discard"),
        ("var<workgroup> a: atomic<u32>;\nfn f() {\n atomicAdd(&a, 1u); }", 3, "atomics"),
        ("fn f() -> u32 { workgroupBarrier(); return 1u; }", 1, "barriers"),
        ("override n: u32;\nfn f() -> u32 {\n return n; }", 3, "no default"),
        ("fn f() -> u32 {\n var a: array<u32, 100000>;\n return a[1]; }", 2, "65536"),
    ] {
        let refused = compile(source).expect_err(source);
        let message = refused.in_source(source);
        assert!(message.starts_with(&format!("line {line},")), "{source}: {message}");
        assert!(message.contains(words), "{source}: {message}");
    }
    assert!(compile("fn g() {}").expect_err("no such function").to_string().contains("`f`"));
}

#[test]
fn a_program_that_grows_without_end_is_refused() {
    use std::fmt::Write;
    let mut source = "fn f0(x: u32) -> u32 { return x * 3u + 1u; }\n".to_owned();
    for level in 1..60 {
        let below = level - 1;
        writeln!(source, "fn f{level}(x: u32) -> u32 {{ return f{below}(f{below}(x)); }}").expect("a string");
    }
    source.push_str("fn f(x: u32) -> u32 { return f59(x); }");
    let refused = compile(&source).expect_err("2^60 calls");
    assert!(refused.message.contains("more than"), "{refused}");
}

#[test]
fn columns_have_to_fit_the_parameters() {
    let program =
        compile("fn f(p: vec2f, n: u32) -> f32 { return p.x + p.y * f32(n); }").expect("it is interpreted");
    let run = |columns: &[Column<'_>], lanes| program.run(columns, lanes, &DeviceModel::ACCURATE);
    assert_eq!(program.parameters()[0], Parameter { name: "p".to_owned(), components: vec![Kind::F32; 2] });
    assert_eq!(program.result(), [Kind::F32]);
    let (x, y, n) = (Column::F32(&[1.0, 2.0, 3.0]), Column::F32(&[10.0]), Column::U32(&[2]));
    assert_eq!(run(&[x, y, n], 3).expect("they fit"), [Values::F32(vec![21.0, 22.0, 23.0])]);
    assert!(run(&[x, y, n], 0).is_err());
    assert_eq!(run(&[y, y, n], 0).expect("no lane is fine"), [Values::F32(vec![])]);
    for (columns, words) in [
        (&[x, y][..], "3 scalars"),
        (&[x, y, y], "`n` wants u32, not f32"),
        (&[x, Column::F32(&[1.0, 2.0]), n], "2 values for 3 lanes"),
    ] {
        let stopped = run(columns, 3).expect_err(words);
        assert!(stopped.to_string().contains(words), "{stopped}");
    }
}

#[test]
fn functions_of_glsl_run_too() {
    let source = "#version 450
        const float weights[3] = float[3](1.0, 2.0, 4.0);
        void split(in float x, out float whole, inout float rest) { whole = floor(x); rest += x - whole; }
        float f(vec2 p, int n) {
            float whole, rest = 0.5;
            split(p.x, whole, rest);
            float sum = whole + rest;
            for (int i = 0; i < 8; ++i) {
                if (i == n) break;
                sum += weights[i % 3] * mod(p.y, 3.0);
            }
            mat2 m = inverse(mat2(2.0, 0.0, 1.0, 1.0)) * outerProduct(vec2(2.0), p);
            return isnan(p.y) || isinf(p.x) ? -1.0 : sum + m[1].x;
        }
        void main() {}";
    let options = naga::front::glsl::Options::from(naga::ShaderStage::Fragment);
    let module = naga::front::glsl::Frontend::default().parse(&options, source).expect("it parses");
    let info = naga::valid::Validator::new(Default::default(), naga::valid::Capabilities::all())
        .validate(&module)
        .expect("it is valid");
    let program = Program::compile(&module, &info, "f").unwrap_or_else(|e| panic!("{}", e.in_source(source)));
    let columns = [Column::F32(&[2.25, -INF]), Column::F32(&[-1.0]), Column::I32(&[4])];
    let values = program.run(&columns, 2, &DeviceModel::ACCURATE).expect("it ends");
    // 2.75 + (1 + 2 + 4 + 1) * 2, and the second column of ((1/2, 0), (-1/2, 1)) (2, 2)^T (p.x, -1) begins with 0.
    assert_eq!(values, [Values::F32(vec![18.75, -1.0])]);
}

#[test]
fn what_languages_leave_open_is_counted_where_it_happens() {
    let source = "fn pick(i: u32) -> u32 { var a = array<u32, 3>(7, 8, 9); return a[i]; }
fn f(i: u32, d: i32) -> u32 {
    var sum = pick(i) + pick(i + 1u);
    if d != 5 { sum += u32(10 / d); }
    return sum + i % 4u;
}";
    let program = compile(source).expect("it is interpreted");
    let indices: Vec<u32> = (0..200).map(|lane| lane % 4).collect();
    let divisors: Vec<i32> = (0..200).map(|lane| if lane % 10 == 0 { 0 } else { 5 }).collect();
    let run = || program.run(&[Column::U32(&indices), Column::I32(&divisors)], 200, &DeviceModel::ACCURATE);
    assert!(run().is_ok());
    let found = |program: &Program| -> Vec<_> {
        let said = |met: &Undefined| (met.kind, &source[met.span.to_range().unwrap()], met.lanes);
        program.undefined().iter().map(|met| (said(met).0, said(met).1.to_owned(), met.lanes)).collect()
    };
    // Index 3 in a quarter of the lanes; 3 and 4 of the other call in a half.
    let index = (UndefinedKind::Index, "a[i]".to_owned(), 150);
    let division = (UndefinedKind::Division, "10 / d".to_owned(), 20);
    assert_eq!(found(&program), [index, division]);
    assert!(run().is_ok());
    assert_eq!(found(&program)[0].2, 300);
    let sound = [Column::U32(&[1]), Column::I32(&[5])];
    let fresh = compile(source).expect("it is interpreted");
    assert!(fresh.run(&sound, 200, &DeviceModel::ACCURATE).is_ok());
    assert_eq!(fresh.undefined(), []);
}
