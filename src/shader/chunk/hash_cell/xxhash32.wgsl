fn xxhash_step(state: u32, word: u32) -> u32 {
    return rotated_left(state + word * 3266489917u, 17u) * 668265263u;
}

// XXH32 over x, y, z, seeded with the octave. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    var h = cell.octave + 374761393u + 12u;
    h = xxhash_step(h, to_word(cell.index.x));
    h = xxhash_step(h, to_word(cell.index.y));
    h = xxhash_step(h, to_word(cell.index.z));
    h = (h ^ (h >> 15u)) * 2246822519u;
    h = (h ^ (h >> 13u)) * 3266489917u;
    return open_lattice(h ^ (h >> 16u));
}
