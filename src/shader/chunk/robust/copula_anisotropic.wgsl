// The eight corners of the box of octaves, mixed as normal quantiles by trilinear weights and scaled back to unit
// variance: uniform, and continuous in each scale. Not in the paper.
fn joined(position: vec3<f32>, scales: Scales) -> f32 {
    var sum = 0.0;
    var variance = 0.0;
    for (var corner = 0; corner < 8; corner++) {
        let fine = vec3<i32>(corner & 1, (corner >> 1u) & 1, (corner >> 2u) & 1);
        let share = select(1.0 - scales.fraction, scales.fraction, fine == vec3<i32>(1));
        let weight = share.x * share.y * share.z;
        sum += weight * normal_quantile(hash_cell(nested_cell(position, scales.octave + fine)));
        variance += weight * weight;
    }
    return normal_cdf(sum / sqrt(variance));
}
