// The pair of a cell whose intervals have these numbers, 0 to 3: two opposite corners of a parent have the same.
fn pair(counted: vec3<u32>) -> u32 {
    return ((counted.x ^ counted.z) & 1u) | (((counted.y ^ counted.z) & 1u) << 1u);
}

// A word of a parent, from the numbers of its intervals: the two upper bits say which pair keeps its threshold, the next ones how
// the others are ordered.
fn order_of_pairs(counted: vec3<u32>, octave: i32) -> u32 {
    let combined = (counted.x & 0x7ffu) | ((counted.y & 0x7ffu) << 11u) | (counted.z << 22u);
    let turned = (bitcast<u32>(octave) << 16u) | (bitcast<u32>(octave) >> 16u);
    let mixed = (combined ^ (combined >> 16u) ^ turned) * 0x7feb352du;
    return (mixed ^ (mixed >> 15u)) * 0x846ca68bu;
}

// True for the pair that keeps the threshold of its parent.
fn keeps(order: u32, of_pair: u32) -> bool {
    return (order >> 30u) == of_pair;
}

// The share that a pair has of [0, 1]: 0 for all of it, 1, 2 or 3 for a third.
fn share_of_pair(order: u32, of_pair: u32) -> u32 {
    let turn = (((order >> 14u) & 0xffffu) * 3u) >> 16u;
    let turned = (of_pair ^ (order >> 30u)) + turn;
    return select(select(turned, turned - 3u, turned > 3u), 0u, keeps(order, of_pair));
}

// The threshold by a share, from the hash of the parent: the two cells of a pair have values half a unit apart.
fn of_share(share: u32, upper: bool, hash: f32) -> f32 {
    let value = select(hash, select(hash - 0.5, hash + 0.5, hash < 0.5), upper);
    let below = select(0.0, 2.0, share == 3u) + select(0.0, 1.0, share == 2u);
    return select((below + value) * 0.33333334, value, share == 0u);
}

// The threshold of a cell of one octave, from the first parent that does not keep that of its own parent; four are asked at most.
fn inherited(cell: vec3<i32>, octave: i32) -> f32 {
    let begin = origin(vec3<i32>(octave));
    var counted = bitcast<vec3<u32>>(cell) + begin;
    var climbed = 0u;
    var order = order_of_pairs(counted >> vec3<u32>(1u), octave - 1);
    while climbed < 3u && keeps(order, pair(counted)) {
        climbed += 1u;
        counted = counted >> vec3<u32>(1u);
        order = order_of_pairs(counted >> vec3<u32>(1u), octave - 1 - i32(climbed));
    }
    let index = vec3<f32>(ancestor(cell, begin, vec3<u32>(climbed + 1u)));
    let hash = hash_cell(Cell(index, bitcast<u32>(octave - 1 - i32(climbed))));
    return of_share(share_of_pair(order, pair(counted)), (counted.z & 1u) == 1u, hash);
}

// The threshold of the cell of one of two octaves, which its coarse cell chooses. Not in the paper.
fn joined(position: vec3<f32>, scales: Scales) -> f32 {
    let octave = scales.octave + select(0, 1, is_fine(position, scales));
    return inherited(vec3<i32>(nested_cell(position, octave).index), octave.x);
}
