fn h(v: vec2<f32>) -> f32 {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

fn cell_hash(position: vec3<f32>, scale: vec3<f32>) -> f32 {
    let c = floor(scale * position);
    let k = h(c.yz);
    return h(vec2<f32>(k, c.z));
}

fn corner_weight(loc: vec3<f32>) -> f32 {
    let near = length(loc);
    let far = length(vec3<f32>(1.0, 1.0, 1.0) - loc);
    return near / (near + far);
}

// Per-axis noise scales.
fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>) -> f32 {
    let d = max(abs(dpdx), abs(dpdy));
    let scales = vec3<f32>(0.707 / d.x, 0.707 / d.y, 0.707 / d.z);
    let l = log2(scales);

    let n0 = cell_hash(position, exp2(floor(l)));
    let n1 = cell_hash(position, exp2(ceil(l)));
    let w = corner_weight(fract(l));
    let x = (1.0 - w) * n0 + w * n1;

    let a = min(w, 1.0 - w);
    let cases = vec3<f32>(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))),
    );
    var t = cases.y;
    if (x >= 1.0 - a) {
        t = cases.z;
    } else if (x < a) {
        t = cases.x;
    }
    return clamp(t, 1.0e-6, 1.0);
}
