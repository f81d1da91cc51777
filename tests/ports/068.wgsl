const HASH_SCALE: f32 = 1.0;

fn pcg(n: u32) -> u32 {
    var h = n * 747796405u + 2891336453u;
    h = ((h >> ((h >> 28u) + 4u)) ^ h) * 277803737u;
    return (h >> 22u) ^ h;
}

fn pcg_cell(cell: vec3<i32>) -> f32 {
    let u = vec3<u32>(cell);
    let h = pcg(u.x + pcg(u.y + pcg(u.z)));
    return f32(h >> 8u) * (1.0 / 16777216.0);
}

fn cdf_of_blend(x: f32, w: f32) -> f32 {
    let a = min(w, 1.0 - w);
    let b = 1.0 - a;
    if (x < a) {
        return 0.5 * x * x / (a * b);
    }
    if (x < b) {
        return (x - 0.5 * a) / b;
    }
    return 1.0 - 0.5 * (1.0 - x) * (1.0 - x) / (a * b);
}

fn threshold(P: vec3<f32>) -> f32 {
    let du = dpdx(P.xy);
    let dv = dpdy(P.xy);
    let pix_scale = 1.0 / (HASH_SCALE * max(length(du), length(dv)));

    let l = log2(pix_scale);
    let cell0 = vec3<i32>(floor(exp2(floor(l)) * P));
    let cell1 = vec3<i32>(floor(exp2(ceil(l)) * P));

    let x = max(pcg_cell(cell0), pcg_cell(cell1));
    return clamp(cdf_of_blend(x, fract(l)), 1.0e-6, 1.0);
}
