// Where the intervals of an octave begin to be counted so that each has the intervals 2 n and 2 n + 1 of the next octave as its
// children, in two's complement: nested cells begin at alternating thirds, whose digits alternate.
fn origin(octave: vec3<i32>) -> vec3<u32> {
    // Twice as much where the octave is odd; some languages choose between floats only.
    return vec3<u32>(0x55555555u) << (bitcast<vec3<u32>>(octave) & vec3<u32>(1u));
}

// The index of an ancestor of an interval, so many octaves above.
fn ancestor(index: vec3<i32>, begin: vec3<u32>, octaves: vec3<u32>) -> vec3<i32> {
    let beyond = begin & ((vec3<u32>(1u) << octaves) - vec3<u32>(1u));
    return (index + bitcast<vec3<i32>>(beyond)) >> octaves;
}
