fn finalize(k: u32) -> u32 {
    var h = k;
    h ^= h >> 16u;
    h *= 0x7feb352du;
    h ^= h >> 15u;
    h *= 0x846ca68bu;
    h ^= h >> 16u;
    return h;
}

fn lattice(p: vec3<f32>, octave: f32) -> f32 {
    let c = vec3<i32>(floor(p * exp2(octave)));
    var h = finalize(bitcast<u32>(i32(octave)));
    h = finalize(h ^ bitcast<u32>(c.x));
    h = finalize(h ^ bitcast<u32>(c.y));
    h = finalize(h ^ bitcast<u32>(c.z));
    return f32(h >> 8u) / 16777216.0;
}

fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>) -> f32 {
    let e = dot(dpdx, dpdx);
    let g = dot(dpdy, dpdy);
    let f = dot(dpdx, dpdy);
    let extent = sqrt(sqrt(max(e * g - f * f, 1.0e-24)));

    let level = log2(1.0 / extent);
    let base = floor(level);
    let w = level - base;

    let x = (1.0 - w) * lattice(position, base) + w * lattice(position, base + 1.0);

    let a = min(w, 1.0 - w);
    let c0 = x * x / (2.0 * a * (1.0 - a));
    let c1 = (x - 0.5 * a) / (1.0 - a);
    let c2 = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));

    var t = c2;
    if (x < a) {
        t = c0;
    } else if (x < 1.0 - a) {
        t = c1;
    }
    return clamp(t, 1.0e-6, 1.0);
}
