// A linear mixture of normal quantiles, scaled back to unit variance: uniform for any weights. Not in the paper.
fn joined(position: vec3<f32>, scales: Scales) -> f32 {
    let weight = scales.fraction.x;
    let coarse = normal_quantile(hash_cell(nested_cell(position, scales.octave)));
    let fine = normal_quantile(hash_cell(nested_cell(position, scales.octave + 1)));
    let sum = (1.0 - weight) * coarse + weight * fine;
    return normal_cdf(sum / sqrt((1.0 - weight) * (1.0 - weight) + weight * weight));
}
