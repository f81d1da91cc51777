// One cell of the grid that cuts space at one scale, and the octave of that scale as one word.
struct Cell {
    index: vec3<f32>,
    octave: u32,
}

// Packs the octave of each axis into one word; equal octaves give that octave.
fn octave_word(octave: vec3<i32>) -> u32 {
    let word = bitcast<vec3<u32>>(octave);
    return word.x + ((word.y - word.x) << 11u) + ((word.z - word.x) << 21u);
}
