// The threshold of sample i of n, jittered within its stratum. Eq. 8.
fn jittered_literal(chi: f32, i: u32, n: u32) -> f32 {
    return (f32(i) + chi) / f32(n);
}
