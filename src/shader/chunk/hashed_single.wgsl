// Section 5.4.1: the scale itself, one hash.
fn hashed(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, hash_scale: f32) -> f32 {
    let pixel_scale = 1.0 / (hash_scale * longest_derivative(dpdx, dpdy));
    return hash_cell(cell_at(position, vec3<f32>(pixel_scale), vec3<f32>(0.0)));
}
