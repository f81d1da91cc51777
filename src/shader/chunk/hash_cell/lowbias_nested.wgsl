// `lowbias32`, nested over the octave, z, y and x, each result added to the next word. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let word = words(cell);
    return open_lattice(lowbias(lowbias(lowbias(lowbias(word.w) + word.z) + word.y) + word.x));
}
