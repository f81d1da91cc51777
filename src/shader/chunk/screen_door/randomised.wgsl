// Strata permuted and jittered for each tile of 4 x 4 pixels and each layer: Eqs. 8 and 9 between pixels. Section 8.1.
fn randomised(pixel: vec2<u32>, layer: u32) -> f32 {
    let tile = pixel / vec2<u32>(4u);
    let xi = vec2<f32>(
        open_lattice(murmur_words(tile.x, tile.y, layer, 0u)),
        open_lattice(murmur_words(tile.x, tile.y, layer, 1u)),
    );
    let own = 2u + (pixel.y % 4u) * 4u + pixel.x % 4u;
    let chi = open_lattice(murmur_words(tile.x, tile.y, layer, own));
    return jittered(chi, decorrelated(xi, ordered(pixel), 16u), 16u);
}
