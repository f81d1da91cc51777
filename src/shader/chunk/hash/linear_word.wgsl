// The four words as one. Not in the paper.
fn linear_word(words: vec4<u32>) -> u32 {
    return weighted_sum(words, vec4<u32>(0xc71f15dfu, 0xd2881b55u, 0x6290e857u, 0x6a46fe4fu));
}
