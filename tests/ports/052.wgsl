fn hash(v: vec2f) -> f32 {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

fn hash_3d(v: vec3f) -> f32 {
    return hash(vec2f(hash(v.xy), v.z));
}

// Interpolated noise of two octaves and the weight between them.
fn two_octaves(p: vec3f, pix_scale: f32) -> vec2f {
    let l = log2(pix_scale);
    let w = fract(l);
    let low = hash_3d(floor(exp2(floor(l)) * p));
    let high = hash_3d(floor(exp2(ceil(l)) * p));
    return vec2f(mix(low, high, w), w);
}

fn threshold(position: vec3f) -> f32 {
    let max_deriv = length(fwidth(position));
    let r = two_octaves(position, 1.0 / max(max_deriv, 1e-8));
    let x = r.x;

    let a = min(r.y, 1.0 - r.y);
    let cases = vec3f(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)),
    );

    var t: f32;
    if (x < 1.0 - a) {
        t = select(cases.y, cases.x, x < a);
    } else {
        t = cases.z;
    }
    return clamp(t, 1.0 / 255.0, 1.0);
}
