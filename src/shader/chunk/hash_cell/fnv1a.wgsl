fn fnv_step(state: u32, unit: u32) -> u32 {
    return (state ^ unit) * 16777619u;
}

// FNV-1a over x, y, z and the octave (Fowler, Noll & Vo 1991). Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let word = words(cell);
    let h = fnv_step(fnv_step(2166136261u, word.x), word.y);
    return open_lattice(fnv_step(fnv_step(h, word.z), word.w));
}
