// True where a cell takes its finer octave: chosen by its own hash.
fn is_fine(position: vec3<f32>, scales: Scales) -> bool {
    var coarse = nested_cell(position, scales.octave);
    coarse.octave = coarse.octave ^ 0x6a09e667u;
    return scales.fraction.x > hash_cell(coarse);
}
