// Listing 2, up to lerpFactor. Literal: an axis along which neither derivative moves has an infinite scale.
fn two_scale(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, hash_scale: f32) -> TwoScale {
    let max_derivative = max(abs(dpdx), abs(dpdy));
    let pixel_scale = 0.707 / (hash_scale * max_derivative);
    let log_scale = log2(pixel_scale);
    let at_floor = floor(log_scale);
    let at_ceil = ceil(log_scale);
    return TwoScale(
        cell_at(position, exp2(at_floor), at_floor),
        cell_at(position, exp2(at_ceil), at_ceil),
        corner_weight(log_scale - at_floor),
    );
}
