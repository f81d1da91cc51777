// Listings 1 and 2: two cells, two hashes, one weight, one uniform value in [1e-6, 1].
fn hashed(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, hash_scale: f32) -> f32 {
    let scales = two_scale(position, dpdx, dpdy, hash_scale);
    let at_floor = hash_cell(scales.floor_cell);
    let at_ceil = hash_cell(scales.ceil_cell);
    let interpolated = (1.0 - scales.lerp_factor) * at_floor + scales.lerp_factor * at_ceil;
    return clamp(cdf(interpolated, scales.lerp_factor), 1.0e-6, 1.0);
}
