fn pcg3d(seed: vec3<u32>) -> vec3<u32> {
    var v = seed * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3<u32>(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

fn noise(p: vec3<f32>) -> f32 {
    let cell = vec3<i32>(floor(p));
    return f32(pcg3d(bitcast<vec3<u32>>(cell)).x >> 8u) / 16777216.0;
}

fn threshold(position: vec3<f32>) -> f32 {
    let d = max(abs(dpdx(position)), abs(dpdy(position)));
    let l = log2(vec3<f32>(0.70710678) / max(d, vec3<f32>(1e-8)));

    let flr = floor(l);
    let n0 = noise(exp2(flr) * position);
    let n1 = noise(exp2(flr + 1.0) * position);

    let loc = l - flr;
    let c0 = length(loc);
    let c1 = length(vec3<f32>(1.0) - loc);
    let w = c0 / (c0 + c1);
    let x = mix(n0, n1, w);

    let a = min(w, 1.0 - w);
    var t: f32;
    if (x < a) {
        t = x * x / (2.0 * a * (1.0 - a));
    } else if (x < 1.0 - a) {
        t = (x - 0.5 * a) / (1.0 - a);
    } else {
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    }
    return clamp(t, 1.0e-6, 1.0);
}
