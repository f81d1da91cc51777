/**
 * Chunk: hashed opacity. Put it in the place of alphaTestPS, e.g.
 *     material.chunks.alphaTestPS = opacityHashedPS;
 * The vertex chunk has to write `vPositionLocal`; see startHashedVS (isn't in this file).
 */
export default /* glsl */`
#ifndef OPACITY_HASHED_GLSL
#define OPACITY_HASHED_GLSL

uniform float alpha_ref;
uniform float material_hashScale;
varying highp vec3 vPositionLocal;

#ifdef MAPTEXTURE
    uniform sampler2D texture_opacityMap;
#endif

#if STD_SHADOWS == 1
    float getShadowPCF3x3(SHADOWMAP_ACCEPT(shadowMap), vec3 shadowCoord, vec3 shadowParams);
#endif

// three integers in, three out; Jarzynski & Olano
uvec3 pcg3d(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

float cellNoise(highp vec3 p) {
    ivec3 cell = ivec3(floor(p));
    uint bits = pcg3d(uvec3(cell)).x;
    // 24 bits, and half a step so that 0 does not occur
    return (float(bits >> 8u) + 0.5) / 16777216.0;
}

float hashedThreshold(highp vec3 p) {
    float maxDeriv = max(length(dFdx(p)), length(dFdy(p)));
    float pixScale = 1.0 / (material_hashScale * maxDeriv);
    float lg = log2(pixScale);
    float s0 = exp2(floor(lg));
    float s1 = exp2(ceil(lg));
    float f = lg - floor(lg);
    float x = mix(cellNoise(s0 * p), cellNoise(s1 * p), f);
    float a = min(f, 1.0 - f);
    float tau;
    if (x < a) {
        tau = x * x / (2.0 * a * (1.0 - a));
    } else if (x < 1.0 - a) {
        tau = (x - 0.5 * a) / (1.0 - a);
    } else {
        tau = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    }
    return clamp(tau, 1.0e-6, 1.0);
}

void maskPixel(float a, float t) {
    if (a < t) discard;
}

void alphaTest(float a) {
    maskPixel(a, hashedThreshold(vPositionLocal));
}

#endif
`;
