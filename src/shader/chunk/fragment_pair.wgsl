// Two fresh random numbers in (0, 1) for every pixel, frame and layer, independent of the stochastic threshold.
fn fragment_pair(pixel: vec2<f32>, frame: u32, layer: u32) -> vec2<f32> {
    let words = fragment_words(pixel, frame, layer);
    return vec2<f32>(open_lattice(words.y), open_lattice(words.z));
}
