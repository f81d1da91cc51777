// Words out of an index: the twin of `drawn_word` in program.rs.

fn drawn_pcg(value: u32) -> u32 {
    let state = value * 747796405u + 2891336453u;
    let mixed = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (mixed >> 22u) ^ mixed;
}

fn drawn_word(seed: u32, index: u32, k: u32) -> u32 {
    return drawn_pcg(k + drawn_pcg(index + drawn_pcg(seed)));
}
