// The share of noise at a level of detail, in [0, 1]: 0 up to level 0, (lod / n)^2 below n, 1 from n on. Eq. 5.
fn blend(lod: f32, n: f32) -> f32 {
    if !is_finite(lod) || lod <= 0.0 {
        // Minus infinity and NaN are no level; plus infinity is beyond every n.
        return select(0.0, 1.0, bitcast<u32>(lod) == 0x7f800000u);
    }
    let share = lod / n;
    if share >= 0.0 && share < 1.0 {
        return share * share;
    }
    return 1.0;
}

// A threshold in (0, 1], faded towards the traditional 1/2 by b in [0, 1]. Eq. 4 as a mixture, then the last clamp.
fn fade_in(threshold_value: f32, b: f32) -> f32 {
    return clamp_last((1.0 - b) * 0.5 + b * threshold_value);
}
