fn pcg3d(v_in: vec3<u32>) -> vec3<u32> {
    var v = v_in * 1664525u + vec3<u32>(1013904223u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3<u32>(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

fn cell_value(p: vec3<f32>) -> f32 {
    let c = vec3<i32>(floor(p));
    let h = pcg3d(bitcast<vec3<u32>>(c));
    return f32(h.x >> 8u) * (1.0 / 16777216.0);
}

fn extent(v: vec3<f32>) -> f32 {
    return v.x * v.x + v.y * v.y + v.z * v.z;
}

fn alpha_threshold(position: vec3<f32>, hash_scale: f32) -> f32 {
    let widest = max(extent(dpdx(position)), extent(dpdy(position)));
    let lg = -log2(hash_scale * widest);

    let noise = vec2<f32>(
        cell_value(position * exp2(floor(lg))),
        cell_value(position * exp2(ceil(lg))),
    );

    let f = fract(lg);
    let x = dot(noise, vec2<f32>(1.0 - f, f));

    let a = min(f, 1.0 - f);
    let den = 2.0 * a * (1.0 - a);
    let p0 = x * x / den;
    let p1 = (x - 0.5 * a) / (1.0 - a);
    let p2 = 1.0 - (1.0 - x) * (1.0 - x) / den;

    let rest = select(p0, p1, x < a);
    let t = select(rest, p2, x >= 1.0 - a);
    return clamp(t, 1.0e-6, 1.0);
}
