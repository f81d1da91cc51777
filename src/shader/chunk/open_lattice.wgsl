// Maps a word to (2k + 1) / 2^24 with k its upper 23 bits: in [2^-24, 1 - 2^-24], never 0 and never 1.
fn open_lattice(word: u32) -> f32 {
    return f32(2u * (word >> 9u) + 1u) * 0x1p-24f;
}
