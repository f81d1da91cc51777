// The lower and the upper half of a product, by products of halves: WGSL has no word of 64 bits.
fn product_of(a: u32, b: u32) -> vec2<u32> {
    let low = (a & 0xffffu) * (b & 0xffffu);
    let left = (a >> 16u) * (b & 0xffffu) + (low >> 16u);
    let right = (a & 0xffffu) * (b >> 16u) + (left & 0xffffu);
    return vec2<u32>(a * b, (a >> 16u) * (b >> 16u) + (left >> 16u) + (right >> 16u));
}

fn wymix(state: vec2<u32>) -> vec2<u32> {
    return product_of(state.x ^ 0x53c5ca59u, state.y ^ 0x74743c1bu);
}

// wyhash for 32-bit machines (Wang Yi 2019), seed 0, over x, y, z and the octave. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let word = words(cell);
    let begun = wymix(wymix(vec2<u32>(0u, 16u)) ^ word.xy);
    let ended = wymix(wymix(begun ^ word.zw));
    return open_lattice(ended.x ^ ended.y);
}
