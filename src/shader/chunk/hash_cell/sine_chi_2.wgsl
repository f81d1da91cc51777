// The paper's second hash (section 9).
fn hash_cell(cell: Cell) -> f32 {
    return hash_2d(cell.index.x, hash_2d(cell.index.y, cell.index.z));
}
