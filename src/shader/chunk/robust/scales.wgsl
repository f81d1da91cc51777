// The longest side of a cell stays between these, where neither it nor its inverse nor an index overflows.
const SMALLEST_SIDE: f32 = 0x1p-100f;
const GREATEST_SIDE: f32 = 0x1p100f;

// The octave and the place within it, in [0, 1), along each axis. Not in the paper.
struct Scales {
    octave: vec3<i32>,
    fraction: vec3<f32>,
}

fn largest_component(v: vec3<f32>) -> f32 {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// Raises sides below 2^-21 of the largest coordinate, so that an index stays below 2^31, or below 2^-5 of the longest
// side, and bounds all of them.
fn floored(side: vec3<f32>, position: vec3<f32>) -> vec3<f32> {
    let coordinate = largest_component(position) * 0x1p-21f;
    let longest = clamp(max(largest_component(side), coordinate), SMALLEST_SIDE, GREATEST_SIDE);
    let smallest = max(longest * 0.03125, min(coordinate, GREATEST_SIDE));
    return clamp(side, vec3<f32>(smallest), vec3<f32>(longest));
}

// Cuts cells per object unit, all normal and above 0, to octaves: the octave out of the bits of the exponent, the
// fraction out of those of the mantissa, so that the two cannot disagree.
fn by_exponent(pixel_scale: vec3<f32>) -> Scales {
    let bits = bitcast<vec3<u32>>(pixel_scale);
    let octave = bitcast<vec3<i32>>(bits >> vec3<u32>(23u)) - 127;
    let mantissa = bitcast<vec3<f32>>((bits & vec3<u32>(0x7fffffu)) | vec3<u32>(0x3f800000u));
    return Scales(octave, clamp(log2(mantissa), vec3<f32>(0.0), vec3<f32>(0.99999994)));
}

// Two to the power of an octave in [-126, 127].
fn power_of_two(octave: vec3<i32>) -> vec3<f32> {
    return bitcast<vec3<f32>>(bitcast<vec3<u32>>(octave + 127) << vec3<u32>(23u));
}

// The cell of a position in the grid with 2^octave cells per object unit. Cells of even octaves begin 1/3 of a cell
// below whole numbers, on which the planes of models lie, and those of odd octaves 2/3; so they nest.
fn nested_cell(position: vec3<f32>, octave: vec3<i32>) -> Cell {
    let scaled = power_of_two(octave) * position;
    let whole = floor(scaled);
    let is_even = (octave & vec3<i32>(1)) == vec3<i32>(0);
    let boundary = select(vec3<f32>(0.33333334), vec3<f32>(0.6666667), is_even);
    let index = select(whole, whole + 1.0, scaled - whole >= boundary);
    return Cell(index, octave_word(octave));
}
