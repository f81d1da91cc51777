// Four fresh random words for every pixel, frame and layer.
fn fragment_words(pixel: vec2<f32>, frame: u32, layer: u32) -> vec4<u32> {
    let place = floor(pixel);
    return pcg4d(vec4<u32>(to_word(place.x), to_word(place.y), frame, layer));
}
