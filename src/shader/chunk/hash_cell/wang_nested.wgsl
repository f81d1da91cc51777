// Wang's 32-bit integer hash (2007).
fn wang(word: u32) -> u32 {
    var h = (word ^ 61u ^ (word >> 16u)) * 9u;
    h = (h ^ (h >> 4u)) * 0x27d4eb2du;
    return h ^ (h >> 15u);
}

// Wang's hash, nested over the octave, z, y and x, each result added to the next word. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let word = words(cell);
    return open_lattice(wang(wang(wang(wang(word.w) + word.z) + word.y) + word.x));
}
