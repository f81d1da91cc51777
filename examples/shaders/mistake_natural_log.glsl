#version 100
// A MISTAKE is in here, one that real ports make: the natural logarithm where Listing 1 has the one to base two. A cell
// is one pixel wide at a scale of 1 only. Each doubling of the scale makes cells smaller by 2^0.69 and not by 2, so that
// the noise gets coarser the closer the camera comes, and finer than a pixel far away.
precision mediump float;

#define octaveOf(s) log(s)

float rand2(highp vec2 v) {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float rand3(highp vec3 v) {
    return rand2(vec2(rand2(v.xy), v.z));
}

float threshold(highp vec3 position, float hash_scale) {
    highp float footprint = max(length(dFdx(position)), length(dFdy(position)));
    highp float scale = 1.0 / (hash_scale * footprint);
    highp float lower = exp2(floor(octaveOf(scale)));
    highp float upper = exp2(ceil(octaveOf(scale)));
    float t = fract(octaveOf(scale));
    float x = mix(rand3(floor(lower * position)), rand3(floor(upper * position)), t);
    float a = min(t, 1.0 - t);
    float tau = x < a ? x * x / (2.0 * a * (1.0 - a))
              : x < 1.0 - a ? (x - 0.5 * a) / (1.0 - a)
              : 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    return clamp(tau, 1.0e-6, 1.0);
}
