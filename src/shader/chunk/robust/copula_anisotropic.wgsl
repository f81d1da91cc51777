// The eight corners of the box of octaves, mixed as normal quantiles by trilinear weights and scaled back to unit
// variance: uniform, and continuous in each scale. Not in the paper.
fn joined(position: vec3<f32>, scales: Scales) -> f32 {
    let coarse = nested_cell(position, scales.octave).index;
    let fine = nested_cell(position, scales.octave + 1).index;
    let fraction = scales.fraction;
    let rest = 1.0 - fraction;
    var sum = 0.0;
    for (var corner = 0; corner < 8; corner++) {
        let is_fine = vec3<bool>((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
        let share = select(rest, fraction, is_fine);
        let octave = octave_word(scales.octave + vec3<i32>(is_fine));
        let hash = hash_cell(Cell(select(coarse, fine, is_fine), octave));
        sum += share.x * share.y * share.z * normal_quantile(hash);
    }
    let variance = rest * rest + fraction * fraction;
    return normal_cdf(sum / sqrt(variance.x * variance.y * variance.z));
}
