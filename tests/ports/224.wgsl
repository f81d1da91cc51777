const HASH_SCALE: f32 = 1.0;

fn hash2(v: vec2<f32>) -> f32 {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

fn noise3(v: vec3<f32>) -> f32 {
    return hash2(vec2<f32>(hash2(v.xy), v.z));
}

fn threshold(p: vec3<f32>) -> f32 {
    let q = p.xzy;
    let d = max(abs(dpdx(q)), abs(dpdy(q)));
    let lg = log2(0.707 / (HASH_SCALE * d));

    let lower = noise3(floor(p * exp2(floor(lg))));
    let upper = noise3(floor(p * exp2(ceil(lg))));

    let f = fract(lg);
    let n0 = length(f);
    let n1 = length(vec3<f32>(1.0, 1.0, 1.0) - f);
    let w = n0 / (n0 + n1);

    let x = lower + (upper - lower) * w;
    let a = min(w, 1.0 - w);

    let cases = vec3<f32>(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)),
    );

    let t = select(select(cases.z, cases.y, x < 1.0 - a), cases.x, x < a);
    return clamp(t, 1.0e-6, 1.0);
}
