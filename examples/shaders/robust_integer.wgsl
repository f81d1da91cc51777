// Robust: an integer hash that takes the octave along, cells that are cut off whole numbers, a footprint that never
// vanishes, Eq. 2 without a division by zero, and a last clamp.

fn mixed(word: u32) -> u32 {
    var h = word;
    h = (h ^ (h >> 16u)) * 0x21f0aaadu;
    h = (h ^ (h >> 15u)) * 0x735a2d97u;
    return h ^ (h >> 15u);
}

fn cell_noise(position: vec3<f32>, octave: i32) -> f32 {
    let scaled = ldexp(position, vec3<i32>(octave));
    // Even and odd octaves are cut at different places, which still nest.
    let edge = select(1.0 / 3.0, 2.0 / 3.0, (octave & 1) == 0);
    let whole = floor(scaled);
    let cell = vec3<i32>(whole + select(vec3<f32>(0.0), vec3<f32>(1.0), scaled - whole >= vec3<f32>(edge)));
    let words = bitcast<vec3<u32>>(cell);
    let h = mixed(words.x + mixed(words.y + mixed(words.z + mixed(u32(octave + 512)))));
    return f32(2u * (h >> 9u) + 1u) / 16777216.0;
}

fn is_number(v: vec3<f32>) -> bool {
    return all((bitcast<vec3<u32>>(v) & vec3<u32>(0x7f800000u)) != vec3<u32>(0x7f800000u));
}

fn threshold(position: vec3<f32>, dpdx: vec3<f32>, dpdy: vec3<f32>, hash_scale: f32) -> f32 {
    if !(is_number(position) && is_number(dpdx) && is_number(dpdy)) {
        return 0.5;
    }
    // A cell is no smaller than what an f32 coordinate can tell apart.
    let reach = max(max(abs(position.x), abs(position.y)), abs(position.z));
    let footprint = hash_scale * max(length(dpdx), length(dpdy));
    let side = clamp(max(footprint, reach / 2097152.0), 1.0e-18, 1.0e18);

    // Octave and fraction come from the same bits, so that they cannot disagree.
    let bits = bitcast<u32>(1.0 / side);
    let octave = i32(bits >> 23u) - 127;
    let weight = clamp(log2(bitcast<f32>((bits & 0x7fffffu) | 0x3f800000u)), 0.0, 0.99999994);

    let x = (1.0 - weight) * cell_noise(position, octave) + weight * cell_noise(position, octave + 1);
    let a = min(weight, 1.0 - weight);
    let b = 1.0 - a;
    var tau = (x - 0.5 * a) / b;
    if x < a {
        tau = 0.5 * x * ((x / a) / b);
    } else if 1.0 - x < a {
        tau = 1.0 - 0.5 * (1.0 - x) * (((1.0 - x) / a) / b);
    }
    return clamp(tau, 1.0 / 16777216.0, 1.0);
}
