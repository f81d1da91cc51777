// Integer Hash III (Quilez 2017).
fn iqint(words: vec2<u32>) -> u32 {
    let mixed = ((words >> vec2<u32>(1u)) ^ words.yx) * 1103515245u;
    return (mixed.x ^ (mixed.y >> 3u)) * 1103515245u;
}

// Integer Hash III of pairs of words, and of both results. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let word = words(cell);
    return open_lattice(iqint(vec2<u32>(iqint(word.xy), iqint(word.zw))));
}
