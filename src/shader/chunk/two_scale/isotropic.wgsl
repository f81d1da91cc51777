// Listing 1, up to lerpFactor. Literal: without a derivative the scale is infinite.
fn two_scale(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, hash_scale: f32) -> TwoScale {
    let max_derivative = longest_derivative(dpdx, dpdy);
    let pixel_scale = 1.0 / (hash_scale * max_derivative);
    let log_scale = log2(pixel_scale);
    let at_floor = vec3<f32>(floor(log_scale));
    let at_ceil = vec3<f32>(ceil(log_scale));
    return TwoScale(
        cell_at(position, exp2(at_floor), at_floor),
        cell_at(position, exp2(at_ceil), at_ceil),
        log_scale - floor(log_scale),
    );
}
