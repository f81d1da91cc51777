// The threshold of frame i of n. Eq. 6.
fn stratified_literal(chi: f32, i: u32, n: u32) -> f32 {
    let sum = chi + f32(i) / f32(n);
    return sum - floor(sum);
}
