// The hash of Schechter & Bridson (2008).
fn esgtsa(word: u32) -> u32 {
    var h = (word ^ 2747636419u) * 2654435769u;
    h = (h ^ (h >> 16u)) * 2654435769u;
    return (h ^ (h >> 16u)) * 2654435769u;
}

// The hash of Schechter & Bridson, nested over the octave, z, y and x, each result added to the next word. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let word = words(cell);
    return open_lattice(esgtsa(esgtsa(esgtsa(esgtsa(word.w) + word.z) + word.y) + word.x));
}
