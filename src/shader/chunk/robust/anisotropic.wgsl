// The scales of Listing 2 for every finite footprint.
fn robust_scales(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, hash_scale: f32) -> Scales {
    let max_derivative = max(abs(dpdx), abs(dpdy));
    let bounded_scale = clamp(hash_scale, SMALLEST_SIDE, GREATEST_SIDE);
    let side = bounded_scale * min(max_derivative, vec3<f32>(GREATEST_SIDE));
    return by_exponent(0.707 / floored(side, position));
}
