// Integral float to i32: saturates, and NaN gives 0. The conversion alone differs among devices there.
fn saturated(x: f32) -> i32 {
    let bits = bitcast<u32>(x);
    if (bits & 0x7f800000u) < 0x4f000000u {
        return i32(x);
    }
    if (bits & 0x7fffffffu) > 0x7f800000u {
        return 0;
    }
    return select(2147483647, -2147483647 - 1, (bits >> 31u) == 1u);
}

fn cell_at(position: vec3<f32>, scale: vec3<f32>, octave: vec3<f32>) -> Cell {
    let whole = vec3<i32>(saturated(octave.x), saturated(octave.y), saturated(octave.z));
    return Cell(floor(scale * position), octave_word(whole));
}
