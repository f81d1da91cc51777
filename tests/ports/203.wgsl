// Shared by the editor preview and the game build.
struct Octaves {
    lower: f32,
    upper: f32,
    w: f32,
}

fn sine_hash(v: vec2f) -> f32 {
    let s = sin(17.0 * v.x + 0.1 * v.y);
    let m = 0.1 + abs(sin(13.0 * v.y + v.x));
    return fract(1.0e4 * s * m);
}

fn sine_hash3(v: vec3f) -> f32 {
    return sine_hash(vec2f(sine_hash(v.xy), v.z));
}

fn octaves(footprint: f32) -> Octaves {
    let l = -log2(max(footprint, 1.0e-9));
    let base = floor(l);
    return Octaves(exp2(base), exp2(base + 1.0), l - base);
}

fn threshold(pos: vec3f, hash_scale: f32) -> f32 {
    let o = octaves(hash_scale * max(length(dpdx(pos)), length(dpdy(pos))));

    let n0 = sine_hash3(floor(pos * o.lower));
    let n1 = sine_hash3(floor(pos * o.upper));
    let x = mix(n0, n1, o.w);

    let a = min(o.w, 1.0 - o.w);
    let b = 1.0 - a;
    var t = (x - 0.5 * a) / b;
    if (x < a) {
        t = x * x / (2.0 * a * b);
    } else if (x >= b) {
        let y = 1.0 - x;
        t = 1.0 - y * y / (2.0 * a * b);
    }
    return clamp(t, 1.0e-6, 1.0);
}
