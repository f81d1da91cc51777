// `lowbias32` of a sum of the words. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    return open_lattice(lowbias(linear_word(words(cell))));
}
