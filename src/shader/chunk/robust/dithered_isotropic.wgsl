// One of the two hashes, chosen by a third hash of the coarse cell. Not in the paper.
fn joined(position: vec3<f32>, scales: Scales) -> f32 {
    return hash_cell(nested_cell(position, scales.octave + select(0, 1, is_fine(position, scales))));
}
