// `triple32` of hash-prospector (Wellons 2018).
fn triple(word: u32) -> u32 {
    var h = (word ^ (word >> 17u)) * 0xed5ad4bbu;
    h = (h ^ (h >> 11u)) * 0xac4c1b51u;
    h = (h ^ (h >> 15u)) * 0x31848babu;
    return h ^ (h >> 14u);
}

// `triple32` of a sum of the words. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    return open_lattice(triple(linear_word(words(cell))));
}
