fn murmur_step(state: u32, word: u32) -> u32 {
    let mixed = state ^ (rotated_left(word * 0xcc9e2d51u, 15u) * 0x1b873593u);
    return rotated_left(mixed, 13u) * 5u + 0xe6546b64u;
}
