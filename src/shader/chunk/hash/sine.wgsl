// The paper's hash of two coordinates (section 5.1). The value is in [0, 1] and rests on the device's sine of large
// arguments, whose accuracy no shading language promises.
fn hash_2d(x: f32, y: f32) -> f32 {
    let amplitude = 1.0e4 * sin(17.0 * x + 0.1 * y);
    let product = amplitude * (0.1 + abs(sin(13.0 * y + x)));
    return product - floor(product);
}
