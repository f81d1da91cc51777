// True where an axis takes its finer octave: chosen by the axis's own interval and octave, nothing of the others.
fn takes_fine(interval: f32, axis: u32, octave: i32, fraction: f32) -> bool {
    let word = 0x80000000u ^ (axis << 24u) ^ (bitcast<u32>(octave) & 0xffffu);
    return fraction > hash_cell(Cell(vec3<f32>(interval, 0.0, 0.0), word));
}

// One hash of the cell whose octave each axis has chosen for itself. Not in the paper.
fn joined(position: vec3<f32>, scales: Scales) -> f32 {
    let coarse = nested_cell(position, scales.octave).index;
    let fine = vec3<bool>(
        takes_fine(coarse.x, 0u, scales.octave.x, scales.fraction.x),
        takes_fine(coarse.y, 1u, scales.octave.y, scales.fraction.y),
        takes_fine(coarse.z, 2u, scales.octave.z, scales.fraction.z),
    );
    return hash_cell(nested_cell(position, scales.octave + vec3<i32>(fine)));
}
