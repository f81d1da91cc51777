#import bevy_pbr::{
    pbr_fragment::pbr_input_from_standard_material,
    pbr_functions::apply_pbr_lighting,
    forward_io::{FragmentOutput},
}

// hashed-alpha 0.1.0: Listing 1 with every repair (not in the paper), join inherit, hash lowbias-linear, noise of 1 pixels
// After C. Wyman and M. McGuire, "Improved Alpha Testing Using Hashed Sampling" (2017).
// Discard a fragment where its alpha is below threshold(position, dpdx, dpdy).
// Verify it: hashed-alpha check FILE --nested-phase --join inherit
//   position: position on the surface, object units
//   dpdx: its change to the next pixel on the right, object units per pixel
//   dpdy: its change to the next pixel along screen y, object units per pixel

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

// The low 32 bits of an integral float in two's complement; saturates beyond 64 bits, and NaN gives 0.
fn to_word(x: f32) -> u32 {
    let bits = bitcast<u32>(x);
    let exponent = (bits >> 23u) & 0xffu;
    if exponent < 158u {
        return bitcast<u32>(i32(x));
    }
    // From 2^31 on conversions differ among devices, so the bits are shifted into place.
    let negative = (bits >> 31u) == 1u;
    let mantissa = (bits & 0x7fffffu) | 0x800000u;
    if exponent >= 190u {
        let is_nan = exponent == 255u && mantissa != 0x800000u;
        return select(0xffffffffu, 0u, negative || is_nan);
    }
    let places = exponent - 150u;
    let magnitude = select(0u, mantissa << (places & 31u), places < 32u);
    return select(magnitude, 0u - magnitude, negative);
}

// The words of a cell: its coordinates and its octave.
fn words(cell: Cell) -> vec4<u32> {
    return vec4<u32>(to_word(cell.index.x), to_word(cell.index.y), to_word(cell.index.z), cell.octave);
}

// Maps a word to (2k + 1) / 2^24 with k its upper 23 bits: in [2^-24, 1 - 2^-24], never 0 and never 1.
fn open_lattice(word: u32) -> f32 {
    return f32(2u * (word >> 9u) + 1u) * 0x1p-24f;
}

// The sum of words times weights.
fn weighted_sum(words: vec4<u32>, weights: vec4<u32>) -> u32 {
    let products = words * weights;
    return products.x + products.y + products.z + products.w;
}

// The four words as one. Not in the paper.
fn linear_word(words: vec4<u32>) -> u32 {
    return weighted_sum(words, vec4<u32>(0xc71f15dfu, 0xd2881b55u, 0x6290e857u, 0x6a46fe4fu));
}

// `lowbias32` of hash-prospector (Wellons 2018). Not in the paper.
fn lowbias(word: u32) -> u32 {
    var h = (word ^ (word >> 16u)) * 0x7feb352du;
    h = (h ^ (h >> 15u)) * 0x846ca68bu;
    return h ^ (h >> 16u);
}

// `lowbias32` of a sum of the words. Not in the paper.
fn hash_cell(cell: Cell) -> f32 {
    return open_lattice(lowbias(linear_word(words(cell))));
}

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

// Euclidean length, summed from left to right; drivers add the terms of the built-in one in orders of their own.
fn length_of(v: vec3<f32>) -> f32 {
    return sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

// Euclidean length of a finite vector; scaled where the plain sum of squares under- or overflows.
fn safe_length(v: vec3<f32>) -> f32 {
    let plain = length_of(v);
    if plain > 0x1p-50f && plain < 0x1p60f {
        return plain;
    }
    let largest = largest_component(v);
    if largest == 0.0 {
        return 0.0;
    }
    return largest * length_of(v / largest);
}

// The scales of Listing 1 for every finite footprint: the same along each axis.
fn robust_scales(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, hash_scale: f32) -> Scales {
    let max_derivative = max(safe_length(dpdx), safe_length(dpdy));
    let bounded_scale = clamp(hash_scale, SMALLEST_SIDE, GREATEST_SIDE);
    let side = vec3<f32>(bounded_scale * min(max_derivative, GREATEST_SIDE));
    return by_exponent(1.0 / floored(side, position));
}

// True where a cell takes its finer octave: chosen by its own hash.
fn is_fine(position: vec3<f32>, scales: Scales) -> bool {
    var coarse = nested_cell(position, scales.octave);
    coarse.octave = coarse.octave ^ 0x6a09e667u;
    return scales.fraction.x > hash_cell(coarse);
}

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

// True for every f32 but NaN and the infinities. By bits: compilers may fold `x != x` to false.
fn is_finite(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7f800000u) != 0x7f800000u;
}

fn all_finite(v: vec3<f32>) -> bool {
    return is_finite(v.x) && is_finite(v.y) && is_finite(v.z);
}

// The threshold with every repair, in [2^-24, 1]. An input that is no number has none and gets that of the
// traditional alpha test, 1/2. Not in the paper.
fn robust(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, hash_scale: f32) -> f32 {
    let has_footprint = all_finite(position) && all_finite(dpdx) && all_finite(dpdy);
    if !(has_footprint && is_finite(hash_scale) && hash_scale > 0.0) {
        return 0.5;
    }
    let scales = robust_scales(position, dpdx, dpdy, hash_scale);
    return clamp(joined(position, scales), 0x1p-24f, 1.0);
}

fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>) -> f32 {
    return robust(position, dpdx, dpdy, 1.0f);
}

struct HashedVertexOutput {
    @builtin(position) position: vec4<f32>,
    @location(0) world_position: vec4<f32>,
    @location(1) world_normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(8) local_position: vec3<f32>,
}

@fragment
fn fragment(in: HashedVertexOutput, @builtin(front_facing) is_front: bool) -> FragmentOutput {
    var input = pbr_input_from_standard_material(in, is_front);
    let alpha = input.material.base_color.a;
    if alpha < threshold(in.local_position, dpdx(in.local_position), dpdy(in.local_position)) {
        discard;
    }
    var out: FragmentOutput;
    out.color = apply_pbr_lighting(input);
    return out;
}
