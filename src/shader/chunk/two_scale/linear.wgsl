// Section 5.4.2, the step before the logarithm. Literal: below one object unit per pixel the first scale is infinite.
fn two_scale(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, hash_scale: f32) -> TwoScale {
    let max_derivative = longest_derivative(dpdx, dpdy);
    let at_floor = vec3<f32>(floor(max_derivative));
    let at_ceil = vec3<f32>(ceil(max_derivative));
    return TwoScale(
        cell_at(position, 1.0 / (hash_scale * at_floor), at_floor),
        cell_at(position, 1.0 / (hash_scale * at_ceil), at_ceil),
        max_derivative - floor(max_derivative),
    );
}
