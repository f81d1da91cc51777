// MurmurHash3 (x86, 32 bits, seed 0) of four words.
fn murmur_words(first: u32, second: u32, third: u32, fourth: u32) -> u32 {
    var h = murmur_step(0u, first);
    h = murmur_step(h, second);
    h = murmur_step(h, third);
    return murmur_end(murmur_step(h, fourth));
}
