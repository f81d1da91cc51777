// Euclidean length, summed from left to right; drivers add the terms of the built-in one in orders of their own.
fn length_of(v: vec3<f32>) -> f32 {
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}
