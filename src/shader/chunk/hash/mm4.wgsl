fn murmur_step(state: u32, word: u32) -> u32 {
    let mixed = state ^ (rotated_left(word * 0xcc9e2d51u, 15u) * 0x1b873593u);
    return rotated_left(mixed, 13u) * 5u + 0xe6546b64u;
}

// MurmurHash3 (x86, 32 bits, seed 0) over x, y, z and the octave. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    var h = murmur_step(0u, integral_word(cell.index.x));
    h = murmur_step(h, integral_word(cell.index.y));
    h = murmur_step(h, integral_word(cell.index.z));
    h = murmur_step(h, cell.octave);
    h = h ^ 16u;
    h = (h ^ (h >> 16u)) * 0x85ebca6bu;
    h = (h ^ (h >> 13u)) * 0xc2b2ae35u;
    return open_lattice(h ^ (h >> 16u));
}
