const AMP: f32 = 1.0e4;

fn noise2(s: f32, t: f32) -> f32 {
    return fract(AMP * sin(17.0 * s + 0.1 * t) * (0.1 + abs(sin(13.0 * t + s))));
}

fn noise3(c: vec3<f32>) -> f32 {
    return noise2(noise2(c.x, c.y), c.z);
}

fn threshold(
    pos: vec3<f32>,
    dpdx: vec3<f32>,
    dpdy: vec3<f32>,
) -> f32 {
    let extent = max(length(dpdx), length(dpdy));
    let lod = log2(1.0 / extent);

    let s = vec2<f32>(exp2(floor(lod)), exp2(ceil(lod)));
    let n0 = noise3(floor(s.x * pos));
    let n1 = noise3(floor(s.y * pos));

    let f = fract(lod);
    let x = (1.0 - f) * n0 + f * n1;

    // piecewise distribution of x
    let a = f;
    let c0 = x * x / (2.0 * a * (1.0 - a));
    let c1 = (x - 0.5 * a) / (1.0 - a);
    let c2 = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    let t = select(c2, select(c1, c0, x < a), x < (1.0 - a));

    return clamp(t, 1.0e-6, 1.0);
}
