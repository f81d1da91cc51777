const HASH_SCALE: f32 = 1.0;

fn hash(a: f32, b: f32) -> f32 {
    return fract(1.0e4 * sin(17.0 * a + 0.1 * b) * (0.1 + abs(sin(13.0 * b + a))));
}

fn hash3(v: vec3<f32>) -> f32 {
    return hash(hash(v.x, v.y), v.z);
}

// Scale at which one cell is about one pixel wide.
fn ideal_scale(p: vec3<f32>) -> f32 {
    let dx = dpdx(p);
    let dy = dpdy(p);
    return 1.0 / (HASH_SCALE * (length(dx) + length(dy)));
}

fn threshold(position: vec3<f32>) -> f32 {
    let lg = log2(ideal_scale(position));
    let lo = exp2(floor(lg));
    let hi = exp2(ceil(lg));

    let n_lo = hash3(floor(lo * position));
    let n_hi = hash3(floor(hi * position));

    let f = fract(lg);
    let x = (1.0 - f) * n_lo + f * n_hi;

    let a = min(f, 1.0 - f);
    let t = select(
        (x - 0.5 * a) / (1.0 - a),
        x * x / (2.0 * a * (1.0 - a)),
        x < a,
    );
    return clamp(t, 1.0e-6, 1.0);
}
