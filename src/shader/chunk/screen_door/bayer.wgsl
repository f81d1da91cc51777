// The place of a pixel in the ordered dither of 8 x 8 (Bayer 1973): the bits of x xor y and of y, interleaved from the lowest.
fn bayer(pixel: vec2<u32>) -> u32 {
    let place = pixel % vec2<u32>(8u);
    let mixed = place.x ^ place.y;
    let outer = ((mixed & 1u) << 5u) | ((place.y & 1u) << 4u) | ((mixed & 2u) << 2u) | ((place.y & 2u) << 1u);
    return outer | ((mixed & 4u) >> 1u) | ((place.y & 4u) >> 2u);
}
