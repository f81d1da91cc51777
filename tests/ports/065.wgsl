fn wang_hash(v: u32) -> u32 {
    var s = (v ^ 61u) ^ (v >> 16u);
    s *= 9u;
    s ^= s >> 4u;
    s *= 0x27d4eb2du;
    s ^= s >> 15u;
    return s;
}

fn combine(h: u32, v: u32) -> u32 {
    return wang_hash(h * 31u + v);
}

fn noise(p: vec3<f32>, level: vec3<f32>) -> f32 {
    let c = bitcast<vec3<u32>>(vec3<i32>(floor(p * exp2(level))));
    let o = bitcast<vec3<u32>>(vec3<i32>(level));
    var h = combine(7u, c.x);
    h = combine(h, c.y);
    h = combine(h, c.z);
    h = combine(h, o.x);
    h = combine(h, o.y);
    h = combine(h, o.z);
    return f32(h >> 8u) / 16777216.0;
}

fn encode(v: f32) -> f32 {
    let low = 12.92 * v;
    let high = 1.055 * pow(max(v, 1e-6), 1.0 / 2.4) - 0.055;
    return select(high, low, v <= 0.0031308);
}

fn threshold(position: vec3<f32>) -> f32 {
    let d = max(abs(dpdx(position)), abs(dpdy(position)));
    let level = log2(vec3<f32>(1.0) / max(d, vec3<f32>(1e-8)));
    let lo = floor(level);

    let loc = level - lo;
    let d0 = length(loc);
    let d1 = length(1.0 - loc);
    let w = d0 / (d0 + d1);
    let x = mix(noise(position, lo), noise(position, lo + 1.0), w);

    let a = min(w, 1.0 - w);
    var t: f32;
    if (x < a) {
        t = x * x / (2.0 * a * (1.0 - a));
    } else if (x < 1.0 - a) {
        t = (x - 0.5 * a) / (1.0 - a);
    } else {
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    }
    return clamp(encode(t), 1.0e-6, 1.0);
}
