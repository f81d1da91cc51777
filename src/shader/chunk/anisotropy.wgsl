// The degree of anisotropy of a texture access whose screen derivatives have these lengths, in [1, 16]; what is no
// length counts as none. Section 7.1.1.
fn anisotropy(first: f32, second: f32) -> f32 {
    if !(is_finite(first) && is_finite(second)) {
        return 1.0;
    }
    let longer = max(first, second);
    let shorter = min(first, second);
    if shorter < 0.0 || longer <= shorter {
        return 1.0;
    }
    if longer >= shorter * 16.0 {
        return 16.0;
    }
    return clamp(longer / shorter, 1.0, 16.0);
}
