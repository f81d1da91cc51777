// The words of a cell: its coordinates and its octave.
fn words(cell: Cell) -> vec4<u32> {
    return vec4<u32>(to_word(cell.index.x), to_word(cell.index.y), to_word(cell.index.z), cell.octave);
}
