// The place of a pixel in the ordered dither of 4 x 4: the bits of x xor y and of y, interleaved from the lowest.
fn ordered(pixel: vec2<u32>) -> u32 {
    let place = pixel % vec2<u32>(4u);
    let mixed = place.x ^ place.y;
    return ((mixed & 1u) << 3u) | ((place.y & 1u) << 2u) | (mixed & 2u) | ((place.y & 2u) >> 1u);
}
