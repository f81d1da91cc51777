// The threshold of sample i of n, jittered within its stratum, in [2^-24, 1]. Eq. 8, with the clamp after it.
fn jittered(chi: f32, i: u32, n: u32) -> f32 {
    return clamp_last((f32(i % n) + chi) / f32(n));
}
