fn squirrel(position: u32, seed: u32) -> u32 {
    var h = position * 0xd2a80a3fu + seed;
    h = (h ^ (h >> 9u)) + 0xa884f197u;
    h = (h ^ (h >> 11u)) * 0x6c736f4bu;
    h = (h ^ (h >> 13u)) + 0xb79f3abbu;
    h = (h ^ (h >> 15u)) * 0x1b56c4f5u;
    return h ^ (h >> 17u);
}

// Squirrel noise, version 5 (Eiserloh 2021), over x, y, z, seeded with the octave. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let word = words(cell);
    return open_lattice(squirrel(word.x + word.y * 198491317u + word.z * 6542989u, word.w));
}
