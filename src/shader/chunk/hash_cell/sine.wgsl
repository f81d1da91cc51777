// The paper's hash3D (section 5.1).
fn hash_cell(cell: Cell) -> f32 {
    return hash_2d(hash_2d(cell.index.x, cell.index.y), cell.index.z);
}
