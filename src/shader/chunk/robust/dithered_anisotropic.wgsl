// True where an axis takes its finer octave: chosen by the axis's own interval and octave, nothing of the others.
fn takes_fine(interval: f32, choice: u32, octave: i32, fraction: f32) -> bool {
    return fraction > hash_cell(Cell(vec3<f32>(interval, 0.0, 0.0), choice ^ bitcast<u32>(octave)));
}

// One hash of the cell whose octave each axis has chosen for itself. Not in the paper.
fn joined(position: vec3<f32>, scales: Scales) -> f32 {
    let coarse = nested_cell(position, scales.octave).index;
    let fine = vec3<bool>(
        takes_fine(coarse.x, 0xbb67ae85u, scales.octave.x, scales.fraction.x),
        takes_fine(coarse.y, 0x3c6ef372u, scales.octave.y, scales.fraction.y),
        takes_fine(coarse.z, 0xa54ff53au, scales.octave.z, scales.fraction.z),
    );
    return hash_cell(nested_cell(position, scales.octave + vec3<i32>(fine)));
}
