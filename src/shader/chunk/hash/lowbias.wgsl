// `lowbias32` of hash-prospector (Wellons 2018). Not in the paper.
fn lowbias(word: u32) -> u32 {
    var h = (word ^ (word >> 16u)) * 0x7feb352du;
    h = (h ^ (h >> 15u)) * 0x846ca68bu;
    return h ^ (h >> 16u);
}
