// The first word of PCG3D over x, y, z (Jarzynski & Olano 2020); does not read the octave. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    let words = vec3<u32>(to_word(cell.index.x), to_word(cell.index.y), to_word(cell.index.z));
    var v = words * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v = v ^ (v >> vec3<u32>(16u));
    v.x += v.y * v.z;
    return open_lattice(v.x);
}
