// Integer noise for alpha hashing.
fn iq3(a: vec3<u32>) -> vec3<u32> {
    var x = a;
    for (var i = 0; i < 3; i++) {
        x = ((x >> vec3<u32>(8u)) ^ x.yzx) * 1103515245u;
    }
    return x;
}

fn value(p: vec3<f32>, octave: f32) -> f32 {
    let cell = vec3<u32>(vec3<i32>(floor(p * exp2(octave))));
    let salt = bitcast<u32>(octave) * 0x85ebca6bu;
    return f32(iq3(cell ^ vec3<u32>(salt)).x >> 8u) / 16777216.0;
}

fn cdf(x: f32, a: f32) -> f32 {
    let b = 1.0 - a;
    if (x < a) {
        return x * x / (2.0 * a * b);
    }
    if (x < b) {
        return (x - 0.5 * a) / b;
    }
    return 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * b);
}

fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>) -> f32 {
    let d = max(length(dpdx), length(dpdy));
    let level = log2(1.0 / max(d, 1e-8));
    let lo = floor(level);
    let f = fract(level);
    let a = min(f, 1.0 - f);

    let blended = mix(value(position, lo), value(position, lo + 1.0), f);
    let x = cdf(blended, a);
    return clamp(cdf(x, a), 1.0e-6, 1.0);
}
