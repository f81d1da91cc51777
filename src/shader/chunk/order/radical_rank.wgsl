// How many of the first n indices have a smaller radical inverse to base 2 than i has: a permutation for every n.
fn radical_rank(i: u32, n: u32) -> u32 {
    var rank = 0u;
    for (var other = 0u; other < n; other++) {
        if mirrored(other) < mirrored(i) {
            rank++;
        }
    }
    return rank;
}
