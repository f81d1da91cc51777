// The stratum of sample i of n in the permutation that the word draws, every one as likely as any other: the rank of
// the sample's own hash among those of all.
fn shuffled(word: u32, i: u32, n: u32) -> u32 {
    let own = pcg(word + i % n);
    var rank = 0u;
    for (var other = 0u; other < n; other++) {
        if pcg(word + other) < own {
            rank++;
        }
    }
    return rank;
}
