alias Cell = vec3<i32>;

fn jenkins(v: u32) -> u32 {
    var x = v;
    x += (x << 10u);
    x ^= (x >> 6u);
    x += (x << 3u);
    x ^= (x >> 11u);
    x += (x << 15u);
    return x;
}

fn cell_value(cell: Cell, octave: i32) -> f32 {
    var h = jenkins(bitcast<u32>(octave) + 0x68bc21ebu);
    h = jenkins(bitcast<u32>(cell.x) ^ h);
    h = jenkins(bitcast<u32>(cell.y) ^ h);
    h = jenkins(bitcast<u32>(cell.z) ^ h);
    h = jenkins(h);
    return f32(h >> 8u) * exp2(-24.0);
}

fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>) -> f32 {
    let d = max(length(dpdx), length(dpdy));
    let level = log2(1.0 / d);
    let octave = i32(floor(level));
    let scale = exp2(floor(level));

    let h0 = cell_value(Cell(floor(position * scale)), octave);
    let h1 = cell_value(Cell(floor(position * (2.0 * scale))), octave + 1);
    let w = fract(level);
    let x = h0 * (1.0 - w) + h1 * w;

    // distribution of a weighted sum of two uniform values
    let a = min(w, 1.0 - w);
    var t: f32;
    if (x < a) {
        t = x * x / (2.0 * a * (1.0 - a));
    } else {
        t = (x - 0.5 * a) / (1.0 - a);
    }
    return clamp(t, 1.0e-6, 1.0);
}
