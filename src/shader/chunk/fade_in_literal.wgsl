// The share of noise at a level of detail. Eq. 5.
fn blend_literal(lod: f32, n: f32) -> f32 {
    if lod <= 0.0 {
        return 0.0;
    }
    if 0.0 < lod && lod < n {
        return (lod / n) * (lod / n);
    }
    return 1.0;
}

// A threshold, faded towards the traditional 1/2. Eq. 4.
fn fade_in_literal(threshold_value: f32, b: f32) -> f32 {
    return 0.5 + (threshold_value - 0.5) * b;
}
