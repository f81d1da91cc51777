fn joined(position: vec3<f32>, scales: Scales) -> f32 {
    return interpolated(position, scales, scales.fraction.x);
}
