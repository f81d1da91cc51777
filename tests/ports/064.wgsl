fn pcg4d(a: vec4u) -> vec4u {
    var v = a * 1664525u + 1013904223u;
    v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
    v ^= v >> vec4u(16u);
    v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
    return v;
}

const SALT: u32 = 0x51ed270bu;

fn grain(p: vec3f) -> f32 {
    let i = vec3u(vec3i(floor(p))) & vec3u(0xffu);
    return f32(pcg4d(vec4u(i, SALT)).x >> 8u) / 16777216.0;
}

fn threshold(position: vec3f) -> f32 {
    let gx = abs(dpdx(position));
    let gy = abs(dpdy(position));
    let g = max(max(gx, gy), vec3f(1e-7));

    let lg = log2(vec3f(0.70710678) / g);
    let k = floor(lg);
    let r = lg - k;

    let toward = length(r);
    let away = length(vec3f(1.0) - r);
    let w = toward / (toward + away);

    let x = grain(position * exp2(k)) * (1.0 - w) + grain(position * exp2(k + 1.0)) * w;

    let a = min(w, 1.0 - w);
    let q = 2.0 * a * (1.0 - a);
    var t = x * x / q;
    if (x >= a) {
        t = (x - 0.5 * a) / (1.0 - a);
    }
    if (x >= 1.0 - a) {
        t = 1.0 - (1.0 - x) * (1.0 - x) / q;
    }
    return clamp(t, 1.0e-6, 1.0);
}
