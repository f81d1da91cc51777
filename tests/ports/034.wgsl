// PCG output function (RXS-M-XS).
fn pcg(v: u32) -> u32 {
    let state = v * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

fn rand(cell: vec3<i32>) -> f32 {
    let c = bitcast<vec3<u32>>(cell);
    let h = pcg(c.x ^ pcg(c.y ^ pcg(c.z)));
    return f32(h >> 8u) / 16777216.0;
}

fn threshold(position: vec3<f32>, hash_scale: f32) -> f32 {
    let dx = length(dpdx(position));
    let dy = length(dpdy(position));
    let pix_scale = hash_scale * max(dx, dy);

    let l = log2(pix_scale);
    let lo = exp2(floor(l));
    let hi = exp2(ceil(l));

    let h0 = rand(vec3<i32>(floor(lo * position)));
    let h1 = rand(vec3<i32>(floor(hi * position)));
    let w = fract(l);
    let x = mix(h0, h1, w);

    let a = min(w, 1.0 - w);
    let p = a * (1.0 - a);
    var t: f32;
    if (x < a) {
        t = x / p;
    } else if (x < 1.0 - a) {
        t = 1.0 / (1.0 - a);
    } else {
        t = (1.0 - x) / p;
    }
    return clamp(t, 1.0e-6, 1.0);
}
