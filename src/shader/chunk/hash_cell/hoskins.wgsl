// Hoskins's hash without sine of three coordinates (2014). Not in the paper.
fn without_sine(coordinates: vec3<f32>) -> f32 {
    let scaled = coordinates * 0.1031;
    let p = scaled - floor(scaled);
    let product = p.x * (p.z + 31.32) + p.y * (p.y + 31.32) + p.z * (p.x + 31.32);
    let value = (p.x + product + (p.y + product)) * (p.z + product);
    return value - floor(value);
}

fn hash_cell(cell: Cell) -> f32 {
    return without_sine(cell.index);
}
