// The stratum of frame i of n, the lower and the upper half in turn: a permutation for every n. Section 7.2.3.
fn alternating(i: u32, n: u32) -> u32 {
    let turn = i % n;
    return turn / 2u + (turn % 2u) * ((n + 1u) / 2u);
}
