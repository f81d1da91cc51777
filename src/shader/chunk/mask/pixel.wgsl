// One value for each pixel, in (0, 1), the same in every frame and layer. Humus 2009.
fn pixel_value(pixel: vec2<u32>) -> f32 {
    return open_lattice(murmur_words(pixel.x, pixel.y, 0u, 0u));
}

// The threshold of sample i of n: regular ones turned by chi, in [2^-24, 1], a whole sum as 1.
fn turned(chi: f32, i: u32, n: u32) -> f32 {
    let sum = chi + f32(i % n) / f32(n);
    return clamp_last(select(sum, sum - 1.0, sum > 1.0));
}
