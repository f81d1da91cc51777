fn one_at_a_time_step(state: u32, unit: u32) -> u32 {
    var h = state + unit;
    h += h << 10u;
    return h ^ (h >> 6u);
}

fn one_at_a_time_end(state: u32) -> u32 {
    var h = state + (state << 3u);
    h = h ^ (h >> 11u);
    return h + (h << 15u);
}

// Jenkins's "one at a time" (1997) over x, y, z and the octave. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let word = words(cell);
    var h = one_at_a_time_step(0u, word.x);
    h = one_at_a_time_step(h, word.y);
    h = one_at_a_time_step(h, word.z);
    return open_lattice(one_at_a_time_end(one_at_a_time_step(h, word.w)));
}
