fn h(v: vec2<f32>) -> f32 {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

fn h3(v: vec3<f32>) -> f32 {
    return h(vec2<f32>(h(v.xy), v.z));
}

fn cdf(x: f32, w: f32) -> f32 {
    let a = min(w, 1.0 - w);
    let k = 2.0 * a * (1.0 - a);
    let head = x * x / k;
    let body = (x - 0.5 * a) / (1.0 - a);
    let tail = 1.0 - (1.0 - x) * (1.0 - x) / k;
    return select(select(tail, body, x < 1.0 - a), head, x < a);
}

// The derivatives come from the ray differentials of the hit.
fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, hash_scale: f32) -> f32 {
    let s = dpdx + dpdy;
    let reach = sqrt(dot(s, s));
    let pix_scale = 1.0 / (hash_scale * reach);

    let lg = log2(pix_scale);
    let coarse = exp2(floor(lg));
    let fine = exp2(ceil(lg));
    let w = fract(lg);

    let x = mix(h3(floor(coarse * position)), h3(floor(fine * position)), w);
    return clamp(cdf(x, w), 1.0e-6, 1.0);
}
