#version 330
// A MISTAKE is in here, one that real ports make: the cases of the CDF are chosen by the interpolation factor, which
// is not what the CDF is taken of. The noise has streaks at some distances, and is not uniform there.

uniform float alpha_hash_scale;

float hash_two(vec2 p) {
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float hash_three(vec3 p) {
    return hash_two(vec2(hash_two(p.xy), p.z));
}

float threshold(vec3 position, vec3 dpdx, vec3 dpdy) {
    float pix_scale = 1.0 / (alpha_hash_scale * max(length(dpdx), length(dpdy)));
    vec2 pix_scales = vec2(exp2(floor(log2(pix_scale))), exp2(ceil(log2(pix_scale))));
    vec2 hashes = vec2(hash_three(floor(pix_scales.x * position)), hash_three(floor(pix_scales.y * position)));
    float lerp_factor = fract(log2(pix_scale));
    float x = mix(hashes.x, hashes.y, lerp_factor);
    float a = min(lerp_factor, 1.0 - lerp_factor);
    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)), (x - 0.5 * a) / (1.0 - a),
                      1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    float tau = (lerp_factor < (1.0 - a)) ? ((lerp_factor < a) ? cases.x : cases.y) : cases.z;
    return clamp(tau, 1.0e-6, 1.0);
}
