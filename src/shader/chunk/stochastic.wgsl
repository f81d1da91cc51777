// Stochastic alpha testing (section 4): a draw from U[0, 1) with 24 bits.
fn stochastic(word: u32) -> f32 {
    return f32(word >> 8u) * 0x1p-24f;
}
