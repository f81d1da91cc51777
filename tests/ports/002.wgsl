// Alpha-hashed materials: returns the value that the alpha is compared with.
const HASH_SCALE: f32 = 1.0;

fn pcg4d(p: vec4<u32>) -> vec4<u32> {
    var v = p * 1664525u + vec4<u32>(1013904223u);
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v = v ^ (v >> vec4<u32>(16u));
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

fn cell_noise(cell: vec3<f32>) -> f32 {
    let c = bitcast<vec3<u32>>(vec3<i32>(floor(cell)));
    let r = pcg4d(vec4<u32>(c, 0x9e3779b9u));
    return f32(r.x >> 8u) / 16777216.0;
}

fn uniform_from_mix(x: f32, w: f32) -> f32 {
    let a = min(w, 1.0 - w);
    if (x < a) {
        return x * x / (2.0 * a * (1.0 - a));
    }
    if (x < 1.0 - a) {
        return (x - 0.5 * a) / (1.0 - a);
    }
    return 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
}

fn threshold(position: vec3<f32>) -> f32 {
    let dx = length(dpdx(position));
    let dy = length(dpdy(position));
    let deriv = min(dx, dy);
    let pix_scale = 1.0 / (HASH_SCALE * deriv);
    let l = log2(pix_scale);
    let fine = cell_noise(exp2(ceil(l)) * position);
    let coarse = cell_noise(exp2(floor(l)) * position);
    let x = coarse * fine;
    return clamp(uniform_from_mix(x, fract(l)), 1.0e-6, 1.0);
}
