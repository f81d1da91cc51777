// Every parameter of a threshold, out of one word: drawing each number by itself would cost as much as a threshold. All are
// drawn in one order whatever is read, so that every row pays the same for its inputs.
var<private> state: u32;
fn unit() -> f32 {
    state = state * 1664525u + 1013904223u;
    return f32(state >> 8u) * 0x1p-24f;
}

// How many samples of a fragment are kept, of which it has SAMPLES; the last state is in the upper bits.
fn kept() -> u32 {
    state = word(0u);
    // A place in [-8, 8)^3, and derivatives of 2^-12 to 2^-5 object units per pixel.
    let length_of_pixel = bitcast<f32>((122u - (state & 7u)) << 23u);
    let position = 16.0 * vec3<f32>(unit(), unit(), unit()) - 8.0;
    let dpdx = length_of_pixel * (2.0 * vec3<f32>(unit(), unit(), unit()) - 1.0);
    let dpdy = length_of_pixel * (2.0 * vec3<f32>(unit(), unit(), unit()) - 1.0);
    let pixel = floor(1024.0 * vec2<f32>(unit(), unit())) + 0.5;
    let frame = u32(8.0 * unit());
    let layer = u32(4.0 * unit());
    let lod = 10.0 * unit() - 2.0;
    let texel_dx = 0.01 + unit();
    let texel_dy = 0.01 + unit();
    let alpha = unit();
    var passed = 0u;
    for (var sample_index = 0u; sample_index < SAMPLES; sample_index++) {
        passed += u32(alpha >= threshold(ARGUMENTS));
    }
    return passed | (state << 8u);
}
