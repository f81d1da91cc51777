// Listing 1, to the letter, with the paper's hash.

fn hash(value: vec2<f32>) -> f32 {
    return fract(1.0e4 * sin(17.0 * value.x + 0.1 * value.y) * (0.1 + abs(sin(13.0 * value.y + value.x))));
}

fn hash3D(value: vec3<f32>) -> f32 {
    return hash(vec2<f32>(hash(value.xy), value.z));
}

fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, hash_scale: f32) -> f32 {
    // Find the discretised derivatives of our coordinates.
    let max_deriv = max(length(dpdx), length(dpdy));
    let pix_scale = 1.0 / (hash_scale * max_deriv);

    // Find the two nearest log-discretised noise scales.
    let pix_scales = vec2<f32>(exp2(floor(log2(pix_scale))), exp2(ceil(log2(pix_scale))));

    // Compute alpha thresholds at our two noise scales.
    let alpha = vec2<f32>(
        hash3D(floor(pix_scales.x * position)),
        hash3D(floor(pix_scales.y * position)),
    );

    // Factor to interpolate, and the interpolation.
    let lerp_factor = fract(log2(pix_scale));
    let x = (1.0 - lerp_factor) * alpha.x + lerp_factor * alpha.y;

    // Pass into the CDF to make the threshold uniform.
    let a = min(lerp_factor, 1.0 - lerp_factor);
    let cases = vec3<f32>(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))),
    );
    var tau: f32;
    if x < 1.0 - a {
        tau = select(cases.y, cases.x, x < a);
    } else {
        tau = cases.z;
    }
    return clamp(tau, 1.0e-6, 1.0);
}
