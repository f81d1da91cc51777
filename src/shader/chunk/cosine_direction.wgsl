// Direction of a ray about the z axis, of length one, out of two numbers in [0, 1]. §9.
fn cosine_direction(chi: vec2<f32>) -> vec3<f32> {
    let angle = 6.2831853 * chi.y;
    return vec3<f32>(sqrt(chi.x) * cos(angle), sqrt(chi.x) * sin(angle), sqrt(max(0.0, 1.0 - chi.x)));
}
