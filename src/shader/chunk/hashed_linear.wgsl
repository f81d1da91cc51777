// Section 5.4.2, the step before the logarithm: a plain mixture, not uniform.
fn hashed(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, hash_scale: f32) -> f32 {
    let scales = two_scale(position, dpdx, dpdy, hash_scale);
    let at_floor = hash_cell(scales.floor_cell);
    let at_ceil = hash_cell(scales.ceil_cell);
    return (1.0 - scales.lerp_factor) * at_floor + scales.lerp_factor * at_ceil;
}
