// Interleaved gradient noise (Jimenez 2014) at a pixel, here x and y, of a frame, here z. Not in the paper.
fn gradient_noise(coordinates: vec3<f32>) -> f32 {
    let p = coordinates.xy + 5.588238 * coordinates.z;
    let slope = 0.06711056 * p.x + 0.00583715 * p.y;
    let value = 52.9829189 * (slope - floor(slope));
    return value - floor(value);
}

fn hash_cell(cell: Cell) -> f32 {
    return gradient_noise(cell.index);
}
