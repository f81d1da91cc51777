// The first word of PCG4D over x, y, z and the octave. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let index = cell.index;
    let words = vec4<u32>(integral_word(index.x), integral_word(index.y), integral_word(index.z), cell.octave);
    return open_lattice(pcg_4d(words).x);
}
