// The place of a pixel in an order of the 4 x 4 that the seed draws, one for the whole screen.
fn random_mask(pixel: vec2<u32>, seed: u32) -> u32 {
    let own = (pixel.y % 4u) * 4u + pixel.x % 4u;
    let own_word = murmur_words(own, seed, 0u, 0u);
    var rank = 0u;
    for (var other = 0u; other < 16u; other++) {
        let word = murmur_words(other, seed, 0u, 0u);
        if word < own_word || (word == own_word && other < own) {
            rank++;
        }
    }
    return rank;
}
