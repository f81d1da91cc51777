// The larger length of the two screen derivatives, in object units per pixel.
fn longest_derivative(dpdx: vec3<f32>, dpdy: vec3<f32>) -> f32 {
    return max(length_of(dpdx), length_of(dpdy));
}
