struct Params {
    position: vec3<f32>,
    scale: f32,
}

fn jenkins_hash(input: u32) -> u32 {
    var x = input;
    x += x << 10u;
    x ^= x >> 6u;
    x += x << 3u;
    x ^= x >> 11u;
    x += x << 15u;
    return x;
}

fn noise(p: Params) -> f32 {
    let c = vec3<u32>(vec3<i32>(floor(p.position * p.scale)));
    var h = jenkins_hash(c.x);
    h = jenkins_hash(c.y ^ h);
    h = jenkins_hash(c.z ^ h);
    h = jenkins_hash(bitcast<u32>(p.scale) ^ h);
    h = jenkins_hash(h);
    // mantissa trick: [1, 2) minus one
    return bitcast<f32>((h >> 9u) | 0x3f800000u) - 1.0;
}

fn alpha_hash(position: vec3<f32>, hash_scale: f32) -> f32 {
    let d = max(length(dpdx(position)), length(dpdy(position)));
    let l = log2(2.0 / (hash_scale * d));

    let n0 = noise(Params(position, exp2(floor(l))));
    let n1 = noise(Params(position, exp2(floor(l) + 1.0)));
    let w = fract(l);
    let x = n0 + w * (n1 - n0);

    let a = min(w, 1.0 - w);
    let ends = 1.0 / (2.0 * a * (1.0 - a));
    var t = (x - 0.5 * a) / (1.0 - a);
    t = select(t, x * x * ends, x < a);
    t = select(t, 1.0 - (1.0 - x) * (1.0 - x) * ends, x >= 1.0 - a);
    return clamp(t, 1.0e-6, 1.0);
}
