// The stratum of frame i of n: a permutation for even n only. Section 7.2.3.
fn alternating_literal(i: u32, n: u32) -> u32 {
    return i / 2u + (i % 2u) * (n / 2u);
}
