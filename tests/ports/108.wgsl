fn wang(v: u32) -> u32 {
    var s = (v ^ 61u) ^ (v >> 16u);
    s *= 9u;
    s = s ^ (s >> 4u);
    s *= 0x27d4eb2du;
    return s ^ (s >> 15u);
}

fn noise(p: vec3<f32>, octave: i32) -> f32 {
    let c = vec3<i32>(floor(p * exp2(f32(octave))));
    var h = wang(u32(octave + 128));
    h = wang(h ^ u32(c.x));
    h = wang(h ^ u32(c.y));
    h = wang(h ^ u32(c.z));
    return f32(h >> 8u) / 16777216.0;
}

fn to_uniform(x: f32, w: f32) -> f32 {
    let a = min(w, 1.0 - w);
    if (x < a) {
        return x * x / (2.0 * a * (1.0 - a));
    }
    if (x < 1.0 - a) {
        return (x - 0.5 * a) / (1.0 - a);
    }
    return 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
}

fn threshold(position: vec3<f32>, hash_scale: f32) -> f32 {
    let dx = length(dpdx(position));
    let dy = length(dpdy(position));
    let level = -log2(hash_scale * max(dx, dy));
    let octave = i32(floor(level));
    let w = level - floor(level);

    let x = mix(noise(position, octave), noise(position, octave + 1), w);
    return clamp(to_uniform(x, w), 1.0e-6, 1.0);
}
