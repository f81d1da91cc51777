const FOOTPRINT: f32 = 1.41421356;

fn pcg(n: u32) -> u32 {
    let s = n * 747796405u + 2891336453u;
    let w = ((s >> ((s >> 28u) + 4u)) ^ s) * 277803737u;
    return (w >> 22u) ^ w;
}

fn cell_noise(q: vec3<f32>) -> f32 {
    let c = vec3<u32>(abs(vec3<i32>(floor(q))));
    let h = pcg(c.x ^ pcg(c.y ^ pcg(c.z ^ 0x68bc21ebu)));
    return f32(h >> 8u) / 16777216.0;
}

fn threshold(position: vec3<f32>) -> f32 {
    let d = max(abs(dpdx(position)), abs(dpdy(position)));
    let l = log2(FOOTPRINT / d);

    let below = cell_noise(position * exp2(floor(l)));
    let above = cell_noise(position * exp2(ceil(l)));

    let f = fract(l);
    let p = length(f);
    let q = length(vec3<f32>(1.0) - f);
    let w = p / (p + q);

    let x = mix(below, above, w);
    let a = min(w, 1.0 - w);
    let b = 1.0 - a;

    if (x < a) {
        return clamp(x * x / (2.0 * a * b), 1.0e-6, 1.0);
    } else if (x < b) {
        return clamp((x - 0.5 * a) / b, 1.0e-6, 1.0);
    }
    return clamp(1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * b), 1.0e-6, 1.0);
}
