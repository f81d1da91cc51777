fn superfast_step(state: u32, word: u32) -> u32 {
    var h = state + (word & 0xffffu);
    h = (h << 16u) ^ ((word >> 16u) << 11u) ^ h;
    return h + (h >> 11u);
}

fn superfast_end(state: u32) -> u32 {
    var h = state ^ (state << 3u);
    h += h >> 5u;
    h = h ^ (h << 4u);
    h += h >> 17u;
    h = h ^ (h << 25u);
    return h + (h >> 6u);
}

// SuperFastHash (Hsieh 2004) over x, y, z and the octave, as 16 bytes. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let word = words(cell);
    let h = superfast_step(superfast_step(16u, word.x), word.y);
    return open_lattice(superfast_end(superfast_step(superfast_step(h, word.z), word.w)));
}
