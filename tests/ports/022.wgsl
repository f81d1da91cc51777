// Used by the depth prepass and by the main pass alike, so that both agree.
fn h2(p: vec2<f32>) -> f32 {
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

fn h3(p: vec3<f32>) -> f32 {
    return h2(vec2<f32>(h2(p.xy), p.z));
}

fn cdf(x: f32, a: f32) -> f32 {
    let b = 1.0 - a;
    if (x < a) {
        return x * x / (2.0 * a * b);
    }
    if (x >= b) {
        let y = 1.0 - x;
        return 1.0 - y * y / (2.0 * a * b);
    }
    return (x - 0.5 * a) / b;
}

fn hashed_alpha_threshold(pos: vec3<f32>) -> f32 {
    let px = dpdx(pos);
    let py = dpdy(pos);
    let max_deriv = max(dot(px, px), dot(py, py));
    let pix_scale = 1.0 / max_deriv;

    let low = exp2(floor(log2(pix_scale)));
    let high = exp2(ceil(log2(pix_scale)));
    let w = fract(log2(pix_scale));

    let x = (1.0 - w) * h3(floor(low * pos)) + w * h3(floor(high * pos));
    return clamp(cdf(x, min(w, 1.0 - w)), 1.0e-6, 1.0);
}
