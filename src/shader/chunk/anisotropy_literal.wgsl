// The degree of anisotropy of a texture access whose screen derivatives have these lengths. Section 7.1.1.
fn anisotropy_literal(first: f32, second: f32) -> f32 {
    return max(first / second, second / first);
}
