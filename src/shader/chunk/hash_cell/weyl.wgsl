// The additive recurrence R3 (Roberts 2018) as a lattice; the octave has the golden ratio. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let weights = vec4<u32>(3518319155u, 2882110345u, 2360945575u, 2654435769u);
    return open_lattice(weighted_sum(words(cell), weights));
}
