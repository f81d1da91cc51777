fn sin_hash(v: vec2f) -> f32 {
    return fract(1e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

fn sin_hash3(v: vec3f) -> f32 {
    return sin_hash(vec2f(sin_hash(v.xy), v.z));
}

struct Blend {
    fine: vec3f,
    coarse: vec3f,
    factor: f32,
}

fn blend_for(d: vec3f) -> Blend {
    let scales = 1.0 / d;
    let l = log2(scales);
    let loc = fract(l);
    let corners = vec2f(length(loc), length(vec3f(1.0) - loc));

    var b: Blend;
    b.coarse = exp2(floor(l));
    b.fine = exp2(ceil(l));
    b.factor = corners.x / (corners.x + corners.y);
    return b;
}

fn threshold(position: vec3f) -> f32 {
    let b = blend_for(max(abs(dpdx(position)), abs(dpdy(position))));
    let x = mix(
        sin_hash3(floor(b.coarse * position)),
        sin_hash3(floor(b.fine * position)),
        b.factor,
    );

    let a = min(b.factor, 1.0 - b.factor);
    var t = (x - 0.5 * a) / (1.0 - a);
    if (x < a) {
        t = x * x / (2.0 * a * (1.0 - a));
    } else if (x >= 1.0 - a) {
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    }
    return clamp(t, 1.0e-6, 1.0);
}
