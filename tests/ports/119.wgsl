fn pcg4d(a: vec4u) -> vec4u {
    var v = a * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> vec4u(16u);
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

fn octave_noise(p: vec3f, octave: f32) -> f32 {
    let cell = bitcast<vec3u>(vec3i(floor(p * exp2(octave))));
    let bits = pcg4d(vec4u(cell, bitcast<u32>(i32(octave))));
    return f32(bits.w >> 8u) / 16777216.0;
}

fn threshold(position: vec3f) -> f32 {
    let deriv = max(length(dpdx(position)), length(dpdy(position)));
    let level = -log2(max(deriv, 1e-8));
    let first = floor(level);
    let f = fract(level);

    let x = (1.0 - f) * octave_noise(position, first)
          + f * octave_noise(position, first + 1.0);

    let a = min(f, 1.0 - f);
    let b = 1.0 - a;
    var t: f32;
    if (x < a) {
        t = x * x / (2.0 * a * b);
    } else if (x < b) {
        t = (x - 0.5 * a) / b;
    } else {
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * b);
    }
    return clamp(t, 1.0e-6, 1.0);
}
