// The stratum of sample i of n: a permutation for powers of two only. Eq. 9.
fn decorrelated_literal(xi: vec2<f32>, i: u32, n: u32) -> u32 {
    let offset = u32(i32(floor(f32(n) * xi.x)));
    let step_size = 2u * u32(i32(floor(0.5 * f32(n) * xi.y))) + 1u;
    return (offset + i * step_size) % n;
}
