// Listing 2, to the letter, with the helpers, structs and pointers that a material system grows. The scale of the noise
// is fixed when the pipeline is built: --set noise_scale=2.

override noise_scale: f32 = 1.0;

struct Octaves {
    below: vec3<f32>,
    above: vec3<f32>,
    fraction: vec3<f32>,
}

fn noise_plane(v: vec2<f32>) -> f32 {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

fn noise_space(v: vec3<f32>) -> f32 {
    return noise_plane(vec2<f32>(noise_plane(v.xy), v.z));
}

fn octaves_of(scales: vec3<f32>, octaves: ptr<function, Octaves>) {
    for (var axis = 0; axis < 3; axis++) {
        let logarithm = log2(scales[axis]);
        (*octaves).below[axis] = exp2(floor(logarithm));
        (*octaves).above[axis] = exp2(ceil(logarithm));
        (*octaves).fraction[axis] = fract(logarithm);
    }
}

fn threshold(dpdx: vec3<f32>, dpdy: vec3<f32>, position: vec3<f32>) -> f32 {
    let derivative = max(abs(dpdx), abs(dpdy));
    var octaves: Octaves;
    octaves_of(0.707 / (noise_scale * derivative), &octaves);

    let noise = vec2<f32>(noise_space(floor(octaves.below * position)), noise_space(floor(octaves.above * position)));
    let to_below = length(octaves.fraction);
    let to_above = length(1.0 - octaves.fraction);
    let weight = to_below / (to_below + to_above);
    let x = (1.0 - weight) * noise.x + weight * noise.y;

    let a = min(weight, 1.0 - weight);
    if x >= 1.0 - a {
        return clamp(1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))), 1.0e-6, 1.0);
    }
    if x < a {
        return clamp(x * x / (2.0 * a * (1.0 - a)), 1.0e-6, 1.0);
    }
    return clamp((x - 0.5 * a) / (1.0 - a), 1.0e-6, 1.0);
}
