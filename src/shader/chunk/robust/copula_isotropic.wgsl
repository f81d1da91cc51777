// A linear mixture of normal quantiles, scaled back to unit variance: uniform for any weights. Not in the paper.
fn joined(position: vec3<f32>, scales: Scales) -> f32 {
    let weight = scales.fraction.x;
    let rest = 1.0 - weight;
    let coarse = normal_quantile(hash_cell(nested_cell(position, scales.octave)));
    let fine = normal_quantile(hash_cell(nested_cell(position, scales.octave + 1)));
    return normal_cdf((rest * coarse + weight * fine) / sqrt(rest * rest + weight * weight));
}
