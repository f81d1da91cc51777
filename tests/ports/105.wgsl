const HASH_SCALE: f32 = 1.0;

fn hash(v: vec2<f32>) -> f32 {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

fn hash3(v: vec3<f32>) -> f32 {
    return hash(vec2<f32>(hash(v.xy), v.z));
}

// value in [0, 1) for the cell that holds p
fn cell(p: vec3<f32>, scale: f32) -> f32 {
    return hash3(floor(p * scale));
}

fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>) -> f32 {
    let max_deriv = max(length(dpdx), length(dpdy));
    let pix_scale = 1.0 / (HASH_SCALE * max_deriv);

    let l = log2(pix_scale);
    let f = fract(l);
    let x = (1.0 - f) * cell(position, exp2(floor(l)))
          + f * cell(position, exp2(ceil(l)));

    let a = min(f, 1.0 - f);
    let c = vec3<f32>(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)),
    );
    let t = select(c.z, select(c.y, c.x, x < a), x < 1.0 - a);
    return clamp(t, 1.0e-6, 1.0);
}
