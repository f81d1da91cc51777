// The weight of Listing 2: how far a point of the box of octaves lies from its first corner, as a share of the sum of
// its distances to both.
fn corner_weight(fraction: vec3<f32>) -> f32 {
    let to_floor = length_of(fraction);
    let to_ceil = length_of(1.0 - fraction);
    return to_floor / (to_floor + to_ceil);
}
