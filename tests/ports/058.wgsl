// Stable stochastic discard.
fn rand_cell(cell: vec3<f32>) -> f32 {
    let k = dot(cell, vec3<f32>(12.9898, 78.233, 37.719));
    return fract(sin(k) * 43758.5453);
}

fn spread(x: f32, f: f32) -> f32 {
    let a = min(f, 1.0 - f);
    let b = max(f, 1.0 - f);
    if (x < a) {
        return x * x / (2.0 * a * b);
    } else if (x < b) {
        return (x - 0.5 * a) / b;
    }
    let y = 1.0 - x;
    return 1.0 - y * y / (2.0 * a * b);
}

fn threshold(position: vec3<f32>, hash_scale: f32) -> f32 {
    let gradient_x = dpdx(position);
    let gradient_y = dpdy(position);
    let max_deriv = max(length(gradient_x), length(gradient_y));
    let pix_scale = 1.0 / (hash_scale * max_deriv);

    let l = log2(pix_scale);
    let s_lo = exp2(floor(l));
    let s_hi = exp2(ceil(l));

    let n_lo = rand_cell(floor(s_lo * position));
    let n_hi = rand_cell(floor(s_hi * position));

    let f = fract(l);
    let x = mix(n_lo, n_hi, f);
    return clamp(spread(x, f), 1.0e-6, 1.0);
}
