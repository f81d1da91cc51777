// The cell by which an axis chooses its octave: its own interval and octave, nothing of the others.
fn interval(index: f32, choice: u32, octave: i32) -> Cell {
    return Cell(vec3<f32>(index, 0.0, 0.0), choice ^ bitcast<u32>(octave));
}

// True along the axes that take their finer octave.
fn takes_fine(position: vec3<f32>, scales: Scales) -> vec3<bool> {
    let coarse = nested_cell(position, scales.octave).index;
    let choice = vec3<f32>(
        hash_cell(interval(coarse.x, 0xbb67ae85u, scales.octave.x)),
        hash_cell(interval(coarse.y, 0x3c6ef372u, scales.octave.y)),
        hash_cell(interval(coarse.z, 0xa54ff53au, scales.octave.z)),
    );
    return scales.fraction > choice;
}
