// Euclidean length of a finite vector; scaled where the plain sum of squares under- or overflows.
fn safe_length(v: vec3<f32>) -> f32 {
    let plain = length_of(v);
    if plain > 0x1p-50f && plain < 0x1p60f {
        return plain;
    }
    let largest = largest_component(v);
    if largest == 0.0 {
        return 0.0;
    }
    return largest * length_of(v / largest);
}

// The scales of Listing 1 for every finite footprint: the same along each axis.
fn robust_scales(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, hash_scale: f32) -> Scales {
    let max_derivative = max(safe_length(dpdx), safe_length(dpdy));
    let bounded_scale = clamp(hash_scale, SMALLEST_SIDE, GREATEST_SIDE);
    let side = vec3<f32>(bounded_scale * min(max_derivative, GREATEST_SIDE));
    return by_exponent(1.0 / floored(side, position));
}
