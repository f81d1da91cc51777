// The bits of a word from the other end; not every language has a function for it.
fn mirrored(word: u32) -> u32 {
    var bits = (word >> 16u) | (word << 16u);
    bits = ((bits & 0x00ff00ffu) << 8u) | ((bits >> 8u) & 0x00ff00ffu);
    bits = ((bits & 0x0f0f0f0fu) << 4u) | ((bits >> 4u) & 0x0f0f0f0fu);
    bits = ((bits & 0x33333333u) << 2u) | ((bits >> 2u) & 0x33333333u);
    return ((bits & 0x55555555u) << 1u) | ((bits >> 1u) & 0x55555555u);
}
