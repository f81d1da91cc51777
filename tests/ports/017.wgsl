// Object-space alpha noise. Derivatives come from the visibility buffer.

fn hash21(p: vec2<f32>) -> f32 {
    let a = sin(17.0 * p.x + 0.1 * p.y);
    let b = 0.1 + abs(sin(13.0 * p.y + p.x));
    return fract(1.0e4 * a * b);
}

fn hash31(p: vec3<f32>) -> f32 {
    let xy = hash21(p.xy);
    return hash21(vec2<f32>(xy, p.z));
}

fn cell_of(p: vec3<f32>, scale: f32) -> vec3<f32> {
    return floor(p * scale + 0.5);
}

fn threshold(
    position: vec3<f32>,
    dpdx: vec3<f32>,
    dpdy: vec3<f32>,
    hash_scale: f32,
) -> f32 {
    let footprint = max(length(dpdx), length(dpdy));
    let scale = 1.0 / (1.0 + hash_scale * footprint);

    let l = log2(scale);
    let below = exp2(floor(l));
    let above = exp2(ceil(l));
    let w = fract(l);

    let x = hash31(cell_of(position, below)) * (1.0 - w)
          + hash31(cell_of(position, above)) * w;

    let a = min(w, 1.0 - w);
    let left = x * x / (2.0 * a * (1.0 - a));
    let middle = (x - 0.5 * a) / (1.0 - a);
    let right = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));

    let t = select(select(middle, left, x < a), right, x >= 1.0 - a);
    return clamp(t, 1.0e-6, 1.0);
}
