fn hash2(v: vec2<f32>) -> f32 {
    let s = sin(17.0 * v.x + 0.1 * v.y);
    let t = 0.1 + abs(sin(13.0 * v.y + v.x));
    return fract(1.0e4 * s * t);
}

fn hash3(v: vec3<f32>) -> f32 {
    return hash2(vec2<f32>(hash2(v.xy), v.z));
}

// `hash_scale` is the artists' knob on the size of the grains.
fn threshold(position: vec3<f32>, hash_scale: f32) -> f32 {
    let max_deriv = max(length(dpdx(position)), length(dpdy(position)));
    let pix_scale = 1.0 / (max_deriv / hash_scale);

    let lg = log2(pix_scale);
    let scales = vec2<f32>(exp2(floor(lg)), exp2(ceil(lg)));
    let noise = vec2<f32>(
        hash3(floor(scales.x * position)),
        hash3(floor(scales.y * position)),
    );

    let w = fract(lg);
    let x = 0.5 * (noise.x + noise.y);

    let a = min(w, 1.0 - w);
    let cases = vec3<f32>(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))),
    );
    var t = cases.z;
    if (x < a) {
        t = cases.x;
    } else if (x < 1.0 - a) {
        t = cases.y;
    }
    return clamp(t, 1.0e-6, 1.0);
}
