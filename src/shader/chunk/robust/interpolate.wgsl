// The paper's join: a linear mixture, made uniform by Eq. 2.
fn interpolated(position: vec3<f32>, scales: Scales, weight: f32) -> f32 {
    let hash_coarse = hash_cell(nested_cell(position, scales.octave));
    let hash_fine = hash_cell(nested_cell(position, scales.octave + 1));
    let mixture = (1.0 - weight) * hash_coarse + weight * hash_fine;
    return cdf(mixture, weight);
}
