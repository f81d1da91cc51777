// One hash of the cell whose octave each axis has chosen for itself. Not in the paper.
fn joined(position: vec3<f32>, scales: Scales) -> f32 {
    return hash_cell(nested_cell(position, scales.octave + vec3<i32>(takes_fine(position, scales))));
}
