// The one-dimensional PCG hash of a word (RXS-M-XS; Jarzynski & Olano 2020). Not in the paper.
fn pcg(word: u32) -> u32 {
    let state = word * 747796405u + 2891336453u;
    let mixed = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (mixed >> 22u) ^ mixed;
}
