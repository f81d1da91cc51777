// The sum of words times weights.
fn weighted_sum(words: vec4<u32>, weights: vec4<u32>) -> u32 {
    let products = words * weights;
    return products.x + products.y + products.z + products.w;
}
