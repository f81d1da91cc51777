fn avalanche(key: u32) -> u32 {
    var k = key;
    k += k << 10u;
    k ^= k >> 6u;
    k += k << 3u;
    k ^= k >> 11u;
    k += k << 15u;
    return k;
}

fn lattice(c: vec3<i32>) -> f32 {
    let u = bitcast<vec3<u32>>(c);
    let k = avalanche(avalanche(u.x ^ avalanche(u.y ^ avalanche(u.z ^ 0x5bd1e995u))));
    return f32(k >> 8u) / 16777216.0;
}

fn inverse_transform(x: f32, a: f32) -> f32 {
    let d = 2.0 * a * (1.0 - a);
    if (x < a) {
        return x * x / d;
    }
    if (x < 1.0 - a) {
        return (x - 0.5 * a) / (1.0 - a);
    }
    return 1.0 - (1.0 - x) * (1.0 - x) / d;
}

fn threshold(position: vec3<f32>) -> f32 {
    let d = max(abs(dpdx(position)), abs(dpdy(position)));
    let scales = 0.707 / max(d, vec3<f32>(1e-8));
    let l = log2(scales);

    let n0 = lattice(vec3<i32>(floor(exp2(floor(l)) * position)));
    let n1 = lattice(vec3<i32>(floor(exp2(ceil(l)) * position)));

    let loc = fract(l);
    let to_corners = vec2<f32>(length(loc), length(1.0 - loc));
    let w = to_corners.x / (to_corners.x + to_corners.y);
    let x = w * n0 + (1.0 - w) * n1;

    let t = inverse_transform(x, min(w, 1.0 - w));
    return clamp(floor(t * 255.0) / 255.0, 0.0, 1.0);
}
