fn hash21(v: vec2f) -> f32 {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

fn hash31(v: vec3f) -> f32 {
    return hash21(vec2f(hash21(v.xy), v.z));
}

// pixel: window coordinates of the fragment
fn threshold(position: vec3f, pixel: vec2f) -> f32 {
    let reach = max(length(dpdx(position)), length(dpdy(position)));
    let level = log2(reach);
    let lower = floor(level);
    let w = level - lower;

    let q = vec3f(pixel, 0.0);
    let v0 = hash31(floor(q * exp2(lower)));
    let v1 = hash31(floor(q * exp2(lower + 1.0)));
    let x = (1.0 - w) * v0 + w * v1;

    let a = min(w, 1.0 - w);
    let b = 1.0 - a;
    var t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * b);
    if (x < b) {
        t = (x - 0.5 * a) / b;
    }
    if (x < a) {
        t = x * x / (2.0 * a * b);
    }
    return clamp(t, 1.0e-6, 1.0);
}
