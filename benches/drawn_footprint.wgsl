// A place in [-8, 8)^3 and derivatives of 2^-12 to 2^-5 object units per pixel, out of one word: drawing each number by
// itself would cost as much as a threshold.
var<private> state: u32;
fn signed() -> f32 {
    state = state * 1664525u + 1013904223u;
    return f32(state >> 8u) * 0x1p-23f - 1.0;
}
fn vector() -> vec3<f32> { return vec3<f32>(signed(), signed(), signed()); }
fn drawn_threshold() -> f32 {
    state = word(0u);
    let pixel = bitcast<f32>((122u - (state & 7u)) << 23u);
    return threshold(8.0 * vector(), pixel * vector(), pixel * vector());
}
