#ifndef HASHED_CUTOUT_GLSL
#define HASHED_CUTOUT_GLSL
// Included by depth_prepass.fs.glsl, shadow.fs.glsl and forward.fs.glsl. All three must agree to the bit, so there's
// exactly one copy of the test and it takes everything it needs as arguments.
//
// GLSL 3.30 + GL_ARB_shading_language_packing

#include "engine/platform.glsl"
#include "engine/math_constants.glsl"

uniform float u_AlphaHashScale;     // pixels, Material::setAlphaHashScale()
uniform uint  u_FrameIndex;
uniform sampler2D u_BlueNoise64;

const float kMinThreshold = 1e-6;

uvec3 pcg3d(uvec3 v)
{
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

float unorm24(uint h)
{
    return float(h >> 8u) * (1.0 / 16777216.0);
}

float cellNoise(vec3 cell)
{
    return unorm24(pcg3d(uvec3(ivec3(cell))).x);
}

// Used by the LOD cross-fade only; that one's allowed to shimmer.
float blueNoise(vec2 fragCoord)
{
    vec2 offset = vec2(float(u_FrameIndex % 8u) * 7.0, float(u_FrameIndex % 5u) * 11.0);
    return texelFetch(u_BlueNoise64, ivec2(fragCoord + offset) & 63, 0).r;
}

bool lodFadeVisible(float fade, vec2 fragCoord)
{
    float n = blueNoise(fragCoord);
    return fade >= 0.0 ? n < fade : n >= 1.0 + fade;
}

/**
 * true: the fragment stays.
 * \param alpha  opacity after all modulation
 * \param pos    position before skinning
 */
bool alphaTestHashed(float alpha, vec3 pos)
{
    float maxDeriv = max(length(dFdx(pos)), length(dFdy(pos)));
    if (alpha >= 1.0)
        return true;    // most of the leaf

    float level    = -log2(u_AlphaHashScale * maxDeriv);
    float lower    = floor(level);
    float blend    = level - lower;

    float n0 = cellNoise(floor(pos * exp2(lower)));
    float n1 = cellNoise(floor(pos * exp2(lower + 1.0)));
    float x  = mix(n0, n1, blend);

    float a = min(blend, 1.0 - blend);
    float b = 1.0 - a;
    float inv2ab = 0.5 / (a * b);

    vec3 cdf = vec3(x * x * inv2ab,
                    (x - 0.5 * a) / b,
                    1.0 - (1.0 - x) * (1.0 - x) * inv2ab);
    int which = int(step(a, x)) + int(step(b, x));

    return alpha >= clamp(cdf[which], kMinThreshold, 1.0);
}

#ifdef SHADOW_PASS
// Shadows are cheaper without: PCF blurs it anyway.
bool alphaTestShadow(float alpha) { return alpha >= 0.5; }
#endif

#endif // HASHED_CUTOUT_GLSL
