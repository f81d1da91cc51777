fn h2(x: f32, y: f32) -> f32 {
    return fract(1.0e4 * sin(17.0 * x + 0.1 * y) * (0.1 + abs(sin(13.0 * y + x))));
}

fn h3(v: vec3<f32>) -> f32 {
    return h2(h2(v.x, v.y), v.z);
}

const ROOT_HALF: f32 = 0.707;

fn threshold(
    position: vec3<f32>,
    dpdx: vec3<f32>,
    dpdy: vec3<f32>,
    hash_scale: f32,
) -> f32 {
    let d = hash_scale * max(abs(dpdx), abs(dpdy));
    let scales = ROOT_HALF / d;
    let l = log2(scales);

    let n = vec2<f32>(
        h3(floor(exp2(floor(l)) * position)),
        h3(floor(exp2(ceil(l)) * position)),
    );

    let loc = fract(l);
    let corners = vec2<f32>(length(loc), length(1.0 - loc));
    let w = corners.x / (corners.x + corners.y);
    let x = dot(n, vec2<f32>(1.0 - w, w));

    let a = min(w, 1.0 - w);
    let q = 2.0 * a * (1.0 - a);
    if (x < a) {
        return clamp(x * x / q, 1.0e-6, 1.0);
    } else if (x < 1.0 - a) {
        return clamp((x - 0.5 * a) / (1.0 - a), 1.0e-6, 1.0);
    }
    return clamp(1.0 - (1.0 - x) * (1.0 - x) / q, 1.0e-6, 1.0);
}
