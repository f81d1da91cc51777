fn rot(x: u32, r: u32) -> u32 {
    return (x << r) | (x >> (32u - r));
}

fn murmur_mix(h: u32, word: u32) -> u32 {
    let k = rot(word * 0xcc9e2d51u, 15u) * 0x1b873593u;
    return rot(h ^ k, 13u) * 5u + 0xe6546b64u;
}

fn murmur_end(v: u32) -> u32 {
    var h = v ^ 16u;
    h = (h ^ (h >> 16u)) * 0x85ebca6bu;
    h = (h ^ (h >> 13u)) * 0xc2b2ae35u;
    return h ^ (h >> 16u);
}

fn noise(p: vec3<f32>, octave: f32) -> f32 {
    let c = bitcast<vec3<u32>>(vec3<i32>(floor(p * exp2(octave))));
    var h = murmur_mix(0x1234567u, bitcast<u32>(i32(octave)));
    h = murmur_mix(h, c.x);
    h = murmur_mix(h, c.y);
    h = murmur_mix(h, c.z);
    return f32(murmur_end(h) >> 8u) / 16777216.0;
}

fn threshold(position: vec3<f32>, hash_scale: f32) -> f32 {
    let d = max(length(dpdx(position)), length(dpdy(position)));
    let level = log2(1.0 / (hash_scale * max(d, 1e-8)));
    let o = floor(level);

    // weight of the finer octave
    let w = step(0.5, level - o);
    let x = mix(noise(position, o), noise(position, o + 1.0), w);

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
