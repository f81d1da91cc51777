// The cell whose name a cell has: along each axis an interval keeps the name of its parent where it is the lower one of two, for
// 16 octaves at most.
fn named(index: vec3<i32>, octave: vec3<i32>) -> Cell {
    let begin = origin(octave);
    let counted = (bitcast<vec3<u32>>(index) + begin) | vec3<u32>(0x10000u);
    // The exponent of the lowest bit that is set: some languages do not count trailing zeros.
    let lowest = counted & (~counted + vec3<u32>(1u));
    let kept = (bitcast<vec3<u32>>(vec3<f32>(lowest)) >> vec3<u32>(23u)) - vec3<u32>(127u);
    return Cell(vec3<f32>(ancestor(index, begin, kept)), octave_word(octave - bitcast<vec3<i32>>(kept)));
}

// One hash of the name of the cell whose octave each axis has chosen for itself. Not in the paper.
fn joined(position: vec3<f32>, scales: Scales) -> f32 {
    let octave = scales.octave + vec3<i32>(takes_fine(position, scales));
    return hash_cell(named(vec3<i32>(nested_cell(position, octave).index), octave));
}
