// The threshold of stratum i of n, in [2^-24, 1]. Eq. 6, with a whole sum as 1 and the clamp after it.
fn stratified(chi: f32, i: u32, n: u32) -> f32 {
    let sum = chi + f32(i % n) / f32(n);
    return clamp_last(select(sum, sum - 1.0, sum > 1.0));
}
