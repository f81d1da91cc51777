fn iq_hash(a: vec3<u32>) -> u32 {
    let k = 1103515245u;
    var x = a;
    x = ((x >> vec3<u32>(8u)) ^ x.yzx) * k;
    x = ((x >> vec3<u32>(8u)) ^ x.yzx) * k;
    x = ((x >> vec3<u32>(8u)) ^ x.yzx) * k;
    return x.x;
}

fn cell_value(position: vec3<f32>, octave: i32) -> f32 {
    let cell = vec3<i32>(floor(position * exp2(f32(octave))));
    let key = bitcast<vec3<u32>>(cell) + vec3<u32>(bitcast<u32>(octave) * 0x9e3779b9u);
    let bits = bitcast<i32>(iq_hash(key));
    return f32(bits) / 2147483648.0;
}

fn threshold(position: vec3<f32>) -> f32 {
    let footprint = max(length(dpdx(position)), length(dpdy(position)));
    let level = log2(1.0 / max(footprint, 1e-8));
    let octave = i32(floor(level));
    let w = fract(level);

    let lower = cell_value(position, octave);
    let upper = cell_value(position, octave + 1);
    let x = mix(lower, upper, w);

    let a = min(w, 1.0 - w);
    let q = 2.0 * a * (1.0 - a);
    var t: f32;
    if (x < a) {
        t = x * x / q;
    } else if (x < 1.0 - a) {
        t = (x - 0.5 * a) / (1.0 - a);
    } else {
        t = 1.0 - (1.0 - x) * (1.0 - x) / q;
    }
    return clamp(t, 1.0e-6, 1.0);
}
