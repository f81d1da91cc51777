// Eq. 2 as Listings 1 and 2 write it; 0 / 0 where x is 1 and lerp_factor 0 or 1.
fn cdf(x: f32, lerp_factor: f32) -> f32 {
    let a = min(lerp_factor, 1.0 - lerp_factor);
    if x < 1.0 - a {
        if x < a {
            return x * x / (2.0 * a * (1.0 - a));
        }
        return (x - 0.5 * a) / (1.0 - a);
    }
    return 1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)));
}
