fn rotl(v: u32, n: u32) -> u32 {
    return (v << n) | (v >> (32u - n));
}

fn murmur3(c: vec3<u32>) -> u32 {
    var words = array<u32, 3>(c.x, c.y, c.z);
    var h = 0u;
    for (var i = 0u; i < 3u; i++) {
        let k = rotl(words[i] * 0xcc9e2d51u, 15u) * 0x1b873593u;
        h = rotl(h ^ k, 13u) * 5u + 0xe6546b64u;
    }
    h ^= 12u;
    h = (h ^ (h >> 16u)) * 0x85ebca6bu;
    h = (h ^ (h >> 13u)) * 0xc2b2ae35u;
    return h ^ (h >> 16u);
}

fn cell_noise(p: vec3<f32>) -> f32 {
    let cell = vec3<i32>(floor(p));
    return f32(murmur3(bitcast<vec3<u32>>(cell)) >> 8u) * exp2(-24.0);
}

fn threshold(P: vec3<f32>) -> f32 {
    let d = max(length(dpdx(P)), length(dpdy(P)));
    let l = log2(1.0 / max(d, 1e-8));
    let lo = floor(l);
    let f = l - lo;

    let x = mix(cell_noise(exp2(lo) * P), cell_noise(exp2(lo + 1.0) * P), f);
    let a = min(f, 1.0 - f);

    var t = (x - 0.5 * a) / (1.0 - a);
    if (x < a) {
        t = x * x / (2.0 * a * (1.0 - a));
    } else if (x >= 1.0 - a) {
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    }
    return clamp(t, 1.0e-6, 1.0);
}
