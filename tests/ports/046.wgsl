fn hash_2(v: vec2<f32>) -> f32 {
    let wave = sin(17.0 * v.x + 0.1 * v.y);
    let gain = 0.1 + abs(sin(13.0 * v.y + v.x));
    return fract(10000.0 * wave * gain);
}

fn hash_3(v: vec3<f32>) -> f32 {
    return hash_2(vec2<f32>(hash_2(v.xy), v.z));
}

fn tail(y: f32, a: f32) -> f32 {
    return y * y / (2.0 * a * (1.0 - a));
}

fn threshold(world_pos: vec3<f32>) -> f32 {
    let size = max(length(dpdx(world_pos)), length(dpdy(world_pos)));
    let l = log2(1.0 / size);

    let below = floor(l);
    let above = ceil(l);
    let h0 = hash_3(floor(exp2(below) * world_pos));
    let h1 = hash_3(floor(exp2(above) * world_pos));

    let f = fract(l);
    let x = mix(h0, h1, f);

    // both ends of the distribution are parabolas, the middle is straight
    let a = min(f, 1.0 - f);
    var t = (x - 0.5 * a) / (1.0 - a);
    if (x < a) {
        t = tail(x, a);
    } else if (x >= 1.0 - a) {
        t = 1.0 - tail(1.0 - x, a);
    }

    t = 0.1 + 0.8 * t;
    return clamp(t, 1.0e-6, 1.0);
}
