// The paper's listings and three integer hashes, as an author would write them.

fn hash_2d(p: vec2f) -> f32 {
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

fn hash_3d(p: vec3f) -> f32 {
    return hash_2d(vec2f(hash_2d(p.xy), p.z));
}

fn cdf(x: f32, lerp_factor: f32) -> f32 {
    let a = min(lerp_factor, 1.0 - lerp_factor);
    let cases = vec3f(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))),
    );
    var threshold: f32;
    if x < 1.0 - a {
        if x < a { threshold = cases.x; } else { threshold = cases.y; }
    } else {
        threshold = cases.z;
    }
    return clamp(threshold, 1.0e-6, 1.0);
}

fn isotropic(position: vec3f, dpdx: vec3f, dpdy: vec3f, hash_scale: f32) -> f32 {
    let max_derivative = max(length(dpdx), length(dpdy));
    let pixel_scale = 1.0 / (hash_scale * max_derivative);
    let scales = vec2f(exp2(floor(log2(pixel_scale))), exp2(ceil(log2(pixel_scale))));
    let alpha = vec2f(hash_3d(floor(scales.x * position)), hash_3d(floor(scales.y * position)));
    let lerp_factor = fract(log2(pixel_scale));
    return cdf((1.0 - lerp_factor) * alpha.x + lerp_factor * alpha.y, lerp_factor);
}

fn anisotropic(position: vec3f, dpdx: vec3f, dpdy: vec3f, hash_scale: f32) -> f32 {
    let derivative = max(abs(dpdx), abs(dpdy));
    let scales = 0.707 / (hash_scale * derivative);
    let log_scales = log2(scales);
    let alpha = vec2f(
        hash_3d(floor(exp2(floor(log_scales)) * position)),
        hash_3d(floor(exp2(ceil(log_scales)) * position)),
    );
    let fraction = fract(log_scales);
    let to_floor = length(fraction);
    let to_ceil = length(1.0 - fraction);
    let lerp_factor = to_floor / (to_floor + to_ceil);
    return cdf((1.0 - lerp_factor) * alpha.x + lerp_factor * alpha.y, lerp_factor);
}

fn open_lattice(word: u32) -> f32 {
    return f32(2u * (word >> 9u) + 1u) * (1.0 / 16777216.0);
}

fn rotate(word: u32, by: u32) -> u32 {
    return (word << by) | (word >> (32u - by));
}

fn mm4(cell: vec3f, octave: i32) -> f32 {
    var words = array<u32, 4>(u32(i32(cell.x)), u32(i32(cell.y)), u32(i32(cell.z)), u32(octave));
    var h = 0u;
    for (var i = 0; i < 4; i++) {
        h ^= rotate(words[i] * 0xcc9e2d51u, 15u) * 0x1b873593u;
        h = rotate(h, 13u) * 5u + 0xe6546b64u;
    }
    h ^= 16u;
    h = (h ^ (h >> 16u)) * 0x85ebca6bu;
    h = (h ^ (h >> 13u)) * 0xc2b2ae35u;
    return open_lattice(h ^ (h >> 16u));
}

fn xxhash32(cell: vec3f, octave: i32) -> f32 {
    let words = vec3u(vec3i(cell));
    var h = u32(octave) + 374761393u + 12u;
    for (var i = 0u; i < 3u; i++) {
        h = rotate(h + words[i] * 3266489917u, 17u) * 668265263u;
    }
    h = (h ^ (h >> 15u)) * 2246822519u;
    h = (h ^ (h >> 13u)) * 3266489917u;
    return open_lattice(h ^ (h >> 16u));
}

fn pcg3d(cell: vec3f, octave: i32) -> f32 {
    var v = vec3u(vec3i(cell)) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3u(16u);
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return open_lattice(v.x);
}
