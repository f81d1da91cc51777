fn hash(v: vec2f) -> f32 {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

fn hash_cell(p: vec3f) -> f32 {
    let c = vec3f(vec3i(p));
    return hash(vec2f(hash(c.xy), c.z));
}

struct Octaves {
    low: f32,
    high: f32,
    weight: f32,
}

fn octaves(d: f32) -> Octaves {
    let l = log2(1.0 / d);
    return Octaves(exp2(floor(l)), exp2(ceil(l)), fract(l));
}

fn threshold(position: vec3f) -> f32 {
    let d = max(length(dpdx(position)), length(dpdy(position)));
    let o = octaves(d);

    let h0 = hash_cell(position * o.low);
    let h1 = hash_cell(position * o.high);
    let x = mix(h0, h1, o.weight);

    let a = min(o.weight, 1.0 - o.weight);
    let k = 2.0 * a * (1.0 - a);
    var t = 0.0;
    if (x < a) {
        t = x * x / k;
    } else if (x < 1.0 - a) {
        t = x / (1.0 - a);
    } else {
        t = 1.0 - (1.0 - x) * (1.0 - x) / k;
    }
    return clamp(t, 1.0e-6, 1.0);
}
