// The first word of PCG4D over x, y, z and the octave. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let index = cell.index;
    let words = vec4<u32>(to_word(index.x), to_word(index.y), to_word(index.z), cell.octave);
    return open_lattice(pcg4d(words).x);
}
