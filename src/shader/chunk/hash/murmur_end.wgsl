// The end of MurmurHash3 (x86, 32 bits) over four words.
fn murmur_end(state: u32) -> u32 {
    var h = state ^ 16u;
    h = (h ^ (h >> 16u)) * 0x85ebca6bu;
    h = (h ^ (h >> 13u)) * 0xc2b2ae35u;
    return h ^ (h >> 16u);
}
