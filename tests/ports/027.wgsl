// Thomas Wang's 32-bit mix.
fn wang(seed: u32) -> u32 {
    var s = seed;
    s = (s ^ 61u) ^ (s >> 16u);
    s = s * 9u;
    s = s ^ (s >> 4u);
    s = s * 0x27d4eb2du;
    return s ^ (s >> 15u);
}

fn noise_at(position: vec3<f32>, level: f32) -> f32 {
    let cell = vec3<i32>(floor(exp2(level) * position));
    let words = array<i32, 4>(cell.x, cell.y, cell.z, i32(level));
    var h = 0u;
    for (var i = 0; i < 4; i++) {
        var w = words;
        h = wang(h + bitcast<u32>(w[i]));
    }
    return f32(h >> 8u) / 16777216.0;
}

fn threshold(position: vec3<f32>) -> f32 {
    let g = max(length(dpdx(position)), length(dpdy(position)));
    let level = -log2(max(g, 1e-8));
    let base = floor(level);
    let w = level - base;

    let x = mix(noise_at(position, base), noise_at(position, base + 1.0), w);

    let a = 0.5;
    var t = 0.0;
    if (x < a) {
        t = x * x / (2.0 * a * (1.0 - a));
    } else if (x < 1.0 - a) {
        t = (x - 0.5 * a) / (1.0 - a);
    } else {
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    }
    return clamp(t, 1.0e-6, 1.0);
}
