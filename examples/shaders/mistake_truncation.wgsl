// A MISTAKE is in here, one that real ports make: the conversion to integers truncates, where Listing 1 takes the
// floor. On both sides of zero lies one cell of twice the size along each axis.

fn murmur(words: vec3<i32>) -> f32 {
    var h = 0u;
    for (var axis = 0; axis < 3; axis++) {
        var k = bitcast<u32>(words[axis]) * 0xcc9e2d51u;
        k = (k << 15u) | (k >> 17u);
        h = h ^ (k * 0x1b873593u);
        h = ((h << 13u) | (h >> 19u)) * 5u + 0xe6546b64u;
    }
    h = (h ^ (h >> 16u)) * 0x85ebca6bu;
    h = (h ^ (h >> 13u)) * 0xc2b2ae35u;
    return f32((h ^ (h >> 16u)) >> 8u) / 16777216.0;
}

fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, hash_scale: f32) -> f32 {
    let level = -log2(hash_scale * max(length(dpdx), length(dpdy)));
    let coarse = murmur(vec3<i32>(exp2(floor(level)) * position));
    let fine = murmur(vec3<i32>(exp2(ceil(level)) * position));
    let t = fract(level);
    let x = mix(coarse, fine, t);
    let a = min(t, 1.0 - t);
    if x < a {
        return max(x * x / (2.0 * a * (1.0 - a)), 1.0e-6);
    }
    if x < 1.0 - a {
        return max((x - 0.5 * a) / (1.0 - a), 1.0e-6);
    }
    return 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
}
