// The spatial hash of Teschner et al. (2003); the prime of the octave is ours. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let word = words(cell) * vec4<u32>(73856093u, 19349663u, 83492791u, 2654435761u);
    return open_lattice(word.x ^ word.y ^ word.z ^ word.w);
}
