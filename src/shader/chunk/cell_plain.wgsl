// One cell of the grid that cuts space at one scale, for a hash that does not read the octave.
struct Cell {
    index: vec3<f32>,
}

fn cell_at(position: vec3<f32>, scale: vec3<f32>, octave: vec3<f32>) -> Cell {
    return Cell(floor(scale * position));
}
