fn stir(k: u32) -> u32 {
    var h = (k ^ (k >> 17u)) * 0xed5ad4bbu;
    h = (h ^ (h >> 11u)) * 0xac4c1b51u;
    h = (h ^ (h >> 15u)) * 0x31848babu;
    return h ^ (h >> 14u);
}

fn spread(c: vec3<i32>) -> u32 {
    let u = bitcast<vec3<u32>>(c);
    return stir(u.z + stir(u.y + stir(u.x + 0x165667b1u)));
}

fn to_unit(h: u32) -> f32 {
    return f32((h & 0x7fffffffu) >> 8u) * (1.0 / 16777216.0);
}

fn threshold(pos: vec3<f32>) -> f32 {
    let m = max(length(dpdx(pos)), length(dpdy(pos)));
    let level = log2(1.0 / m);
    let f = level - floor(level);

    var values = array<f32, 2>(0.0, 0.0);
    for (var i = 0; i < 2; i++) {
        let scale = exp2(floor(level) + f32(i));
        values[i] = to_unit(spread(vec3<i32>(floor(pos * scale))));
    }

    let x = values[0] * (1.0 - f) + values[1] * f;
    let a = min(f, 1.0 - f);

    var t: f32;
    if (x < a) {
        t = x * x / (2.0 * a * (1.0 - a));
    } else if (x < 1.0 - a) {
        t = (x - 0.5 * a) / (1.0 - a);
    } else {
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    }
    return clamp(t, 1.0e-6, 1.0);
}
