// Dithered alpha test that sticks to the surface.

fn pcg4d(seed: vec4<u32>) -> vec4<u32> {
    var v = seed * vec4<u32>(1664525u) + vec4<u32>(1013904223u);
    v.x = v.x + v.y * v.w;
    v.y = v.y + v.z * v.x;
    v.z = v.z + v.x * v.y;
    v.w = v.w + v.y * v.z;
    v = v ^ (v >> vec4<u32>(16u, 16u, 16u, 16u));
    v.x = v.x + v.y * v.w;
    v.y = v.y + v.z * v.x;
    v.z = v.z + v.x * v.y;
    v.w = v.w + v.y * v.z;
    return v;
}

fn noise(position: vec3<f32>, octave: f32) -> f32 {
    let cell = vec3<i32>(floor(position * exp2(octave)));
    let bits = pcg4d(vec4<u32>(vec3<u32>(cell), u32(i32(octave))));
    let r = vec3<f32>(bits.xyz >> vec3<u32>(8u)) / 16777216.0;
    return (r.x + r.y + r.z) / 3.0;
}

fn threshold(position: vec3<f32>) -> f32 {
    let gx = abs(dpdx(position));
    let gy = abs(dpdy(position));
    let g = max(gx, gy);
    let d = max(g.x, max(g.y, g.z));

    let level = log2(1.0 / max(d, 1e-8));
    let lo = floor(level);
    let w = level - lo;

    let x = mix(noise(position, lo), noise(position, lo + 1.0), w);

    let a = min(w, 1.0 - w);
    let c0 = x * x / (2.0 * a * (1.0 - a));
    let c1 = (x - 0.5 * a) / (1.0 - a);
    let c2 = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    let t = select(c2, select(c1, c0, x < a), x < 1.0 - a);
    return clamp(t, 1.0e-6, 1.0);
}
