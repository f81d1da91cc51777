fn sine_hash(v: vec2f) -> f32 {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

fn sine_hash3(v: vec3f) -> f32 {
    return sine_hash(vec2f(sine_hash(v.xy), v.z));
}

struct Noise {
    low: f32,
    high: f32,
    weight: f32,
}

fn sample_noise(p: vec3f, scale: f32) -> Noise {
    let l = log2(scale);
    var n: Noise;
    n.low = sine_hash3(floor(exp2(floor(l)) * p));
    n.high = sine_hash3(floor(exp2(ceil(l)) * p));
    n.weight = fract(l);
    return n;
}

fn hashed_alpha(pos: vec3f) -> f32 {
    let d = max(length(dpdx(pos)), length(dpdy(pos)));
    let n = sample_noise(pos, 1.0 / d);

    let x = n.low + n.weight * (n.high - n.low);
    let a = min(n.weight, 1.0 - n.weight);
    let k = 1.0 / (2.0 * a * (1.0 - a));

    var t = 0.0;
    if (x < a) {
        t = x * x * k;
    } else if (x < 1.0 - a) {
        t = (x - 0.5 * a) / (1.0 - a);
    } else {
        t = 1.0 - (1.0 - x) * (1.0 - x) * k;
    }
    return clamp(t, 1.0e-6, 1.0);
}
