// Bit mixing by Bob Jenkins (one-at-a-time, word variant).
fn mix_word(a: u32) -> u32 {
    var x = a + (a << 10u);
    x = x ^ (x >> 6u);
    x = x + (x << 3u);
    x = x ^ (x >> 11u);
    return x + (x << 15u);
}

fn value(p: vec3<f32>, octave: i32) -> f32 {
    let c = vec3<i32>(floor(p * exp2(f32(octave))));
    let key = bitcast<u32>(c.x ^ c.y ^ c.z);
    let h = mix_word(mix_word(key ^ mix_word(bitcast<u32>(octave))));
    return f32(h >> 8u) / 16777216.0;
}

fn equalize(x: f32, w: f32) -> f32 {
    let a = min(w, 1.0 - w);
    let c = vec3<f32>(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)),
    );
    if (x < a) { return c.x; }
    if (x < 1.0 - a) { return c.y; }
    return c.z;
}

fn threshold(position: vec3<f32>) -> f32 {
    let d = max(length(dpdx(position)), length(dpdy(position)));
    let l = log2(1.0 / d);
    let k = i32(floor(l));
    let w = l - floor(l);
    let x = mix(value(position, k), value(position, k + 1), w);
    return clamp(equalize(x, w), 1.0e-6, 1.0);
}
