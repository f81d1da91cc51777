// The threshold of sample i of n under the fixed dither. Eq. 7.
fn regular(i: u32, n: u32) -> f32 {
    return (f32(i % n) + 0.5) / f32(n);
}
