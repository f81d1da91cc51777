fn rand2(v: vec2<f32>) -> f32 {
    return fract(sin(dot(v, vec2<f32>(12.9898, 78.233))) * 43758.5453);
}

fn rand3(v: vec3<f32>) -> f32 {
    return rand2(vec2<f32>(rand2(v.xy), v.z));
}

// Anisotropic version: every axis has an octave of its own.
fn threshold(position: vec3<f32>) -> f32 {
    let deriv = max(abs(dpdx(position)), abs(dpdy(position)));
    let scales = vec3<f32>(0.707) / deriv;
    let l = log2(scales);

    let lower = exp2(floor(l));
    let upper = exp2(ceil(l));
    let n = vec2<f32>(
        rand3(floor(lower * position)),
        rand3(floor(upper * position)),
    );

    // distance to either corner of the cube of octaves
    let loc = fract(l);
    let to_low = length(loc);
    let to_high = length(vec3<f32>(1.0) - loc);
    let w = to_low / (to_low + to_high);

    let x = mix(n.x, n.y, w);
    let a = min(w, 1.0 - w);
    let cases = vec3<f32>(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)))
    );
    let t = select(cases.z, select(cases.y, cases.x, x < a), x < 1.0 - a);
    return clamp(t, 1.0e-6, 1.0);
}
