#version 300 es
// Listing 1 as an engine for browsers holds it: chunks behind switches, macros for what every chunk needs.
precision highp float;
precision highp int;

#define USE_NOISE_ALPHA
#define SQUARED(v) ((v) * (v))
#define NOISE_SCALE 1.0
#ifdef GL_ES
    #define SMALLEST_TAU 1.0e-6
#else
    #error this chunk is for OpenGL ES
#endif

#ifdef USE_NOISE_ALPHA

const highp float noiseAmplitude = 1.0e4;

highp float planarNoise(const in highp vec2 v) {
    return fract(noiseAmplitude * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

highp float spatialNoise(const in highp vec3 v) {
    return planarNoise(vec2(planarNoise(v.xy), v.z));
}

struct NoiseOctaves {
    highp vec2 scales;
    highp float between;
};

NoiseOctaves octavesAround(const in highp float scale) {
    NoiseOctaves octaves;
    octaves.scales = vec2(exp2(floor(log2(scale))), exp2(ceil(log2(scale))));
    octaves.between = fract(log2(scale));
    return octaves;
}

highp float uniformised(const in highp float x, const in highp float weight) {
    highp float a = min(weight, 1.0 - weight);
    if (x >= 1.0 - a) return 1.0 - (SQUARED(1.0 - x) / (2.0 * a * (1.0 - a)));
    if (x < a) return SQUARED(x) / (2.0 * a * (1.0 - a));
    return (x - 0.5 * a) / (1.0 - a);
}

highp float threshold(const in highp vec3 position, const in highp vec3 dpdx, const in highp vec3 dpdy) {
    highp float footprint = max(length(dpdx), length(dpdy));
    NoiseOctaves octaves = octavesAround(1.0 / (NOISE_SCALE * footprint));
    highp float coarse = spatialNoise(floor(octaves.scales.x * position));
    highp float fine = spatialNoise(floor(octaves.scales.y * position));
    highp float x = (1.0 - octaves.between) * coarse + octaves.between * fine;
    return clamp(uniformised(x, octaves.between), SMALLEST_TAU, 1.0);
}

#endif
