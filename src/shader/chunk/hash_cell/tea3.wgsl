// Three rounds of TEA with the key of Zafar, Olano & Curtis (2010).
fn tea(words: vec2<u32>) -> vec2<u32> {
    var v = words;
    var sum = 0u;
    for (var turn = 0u; turn < 3u; turn++) {
        sum += 0x9e3779b9u;
        v.x += ((v.y << 4u) + 0xa341316cu) ^ (v.y + sum) ^ ((v.y >> 5u) + 0xc8013ea4u);
        v.y += ((v.x << 4u) + 0xad90777du) ^ (v.x + sum) ^ ((v.x >> 5u) + 0x7e95761eu);
    }
    return v;
}

// The first word of TEA over z and the octave, mixed with TEA over x and y. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let word = words(cell);
    return open_lattice(tea(tea(word.xy) ^ word.zw).x);
}
