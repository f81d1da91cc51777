// Eq. 2 without a division by zero: in [0, 1] and non-decreasing in x for every x and lerp_factor in [0, 1].
fn cdf(x: f32, lerp_factor: f32) -> f32 {
    let a = min(lerp_factor, 1.0 - lerp_factor);
    let b = 1.0 - a;
    let from_top = 1.0 - x;
    if x < a {
        return 0.5 * x * ((x / a) / b);
    }
    if from_top < a {
        return 1.0 - 0.5 * from_top * ((from_top / a) / b);
    }
    return (x - 0.5 * a) / b;
}
