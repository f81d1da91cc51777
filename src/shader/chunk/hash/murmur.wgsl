fn murmur_step(state: u32, word: u32) -> u32 {
    let mixed = state ^ (rotated_left(word * 0xcc9e2d51u, 15u) * 0x1b873593u);
    return rotated_left(mixed, 13u) * 5u + 0xe6546b64u;
}

// The end of MurmurHash3 (x86, 32 bits) over four words.
fn murmur_end(state: u32) -> u32 {
    var h = state ^ 16u;
    h = (h ^ (h >> 16u)) * 0x85ebca6bu;
    h = (h ^ (h >> 13u)) * 0xc2b2ae35u;
    return h ^ (h >> 16u);
}
