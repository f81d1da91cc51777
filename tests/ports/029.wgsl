fn fmix32(k: u32) -> u32 {
    var h = k;
    h ^= h >> 16u;
    h *= 0x85ebca6bu;
    h ^= h >> 13u;
    h *= 0xc2b2ae35u;
    h ^= h >> 16u;
    return h;
}

fn body(h: u32, word: u32) -> u32 {
    var k = word * 0xcc9e2d51u;
    k = (k << 15u) | (k >> 17u);
    k = k * 0x1b873593u;
    var r = h ^ k;
    r = (r << 13u) | (r >> 19u);
    return r * 5u + 0xe6546b64u;
}

fn hash_cell(p: vec3<f32>) -> f32 {
    let c = vec3<u32>(vec3<i32>(floor(p)));
    let h = fmix32(body(body(body(0u, c.x), c.y), c.z) ^ 12u);
    return f32(h >> 8u) / 16777216.0;
}

fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>) -> f32 {
    let d = max(abs(dpdx), abs(dpdy));
    let scales = vec3<f32>(0.707 / d.y, 0.707 / d.x, 0.707 / d.z);

    let l = log2(scales);
    let flr = floor(l);
    let loc = l - flr;

    let u = length(loc);
    let v = length(1.0 - loc);
    let w = u / (u + v);

    let n0 = hash_cell(exp2(flr) * position);
    let n1 = hash_cell(exp2(flr + 1.0) * position);
    let x = (1.0 - w) * n0 + w * n1;

    let a = min(w, 1.0 - w);
    let b = 1.0 - a;
    if (x < a) {
        return clamp(x * x / (2.0 * a * b), 1.0e-6, 1.0);
    }
    if (x < b) {
        return clamp((x - 0.5 * a) / b, 1.0e-6, 1.0);
    }
    return clamp(1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * b), 1.0e-6, 1.0);
}
