// MurmurHash3 (x86, 32 bits, seed 0) over x, y, z and the octave. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    var h = murmur_step(0u, to_word(cell.index.x));
    h = murmur_step(h, to_word(cell.index.y));
    h = murmur_step(h, to_word(cell.index.z));
    return open_lattice(murmur_end(murmur_step(h, cell.octave)));
}
