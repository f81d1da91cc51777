// The hash of a cell: PCG nested over the octave, z, y and x, each result added to the next word.
fn hash_cell(cell: Cell) -> f32 {
    var h = pcg(cell.octave);
    h = pcg(h + to_word(cell.index.z));
    h = pcg(h + to_word(cell.index.y));
    h = pcg(h + to_word(cell.index.x));
    return open_lattice(h);
}
