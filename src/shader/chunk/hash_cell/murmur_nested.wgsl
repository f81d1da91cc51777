// The end of MurmurHash3, nested over the octave, z, y and x, each result added to the next word. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let word = words(cell);
    return open_lattice(murmur_end(murmur_end(murmur_end(murmur_end(word.w) + word.z) + word.y) + word.x));
}
