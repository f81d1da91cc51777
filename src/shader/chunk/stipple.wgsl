// Whether a pixel is the odd one of an odd row. Ols 2009.
fn is_apart(pixel: vec2<u32>) -> bool {
    return (pixel.x & pixel.y & 1u) == 1u;
}
