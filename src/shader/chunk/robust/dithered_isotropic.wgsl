// One of the two hashes, chosen by a third hash of the coarse cell. Not in the paper.
fn joined(position: vec3<f32>, scales: Scales) -> f32 {
    var coarse = nested_cell(position, scales.octave);
    coarse.octave = coarse.octave ^ 0x6a09e667u;
    let takes_fine = scales.fraction.x > hash_cell(coarse);
    return hash_cell(nested_cell(position, scales.octave + select(0, 1, takes_fine)));
}
