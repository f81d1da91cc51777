#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_nonuniform_qualifier : require

#include "gbuffer_common.glsl"
#include "bindless.glsl"

layout(constant_id = 0) const bool ALPHA_MASKED = true;
layout(constant_id = 1) const bool HAS_NORMAL_MAP = true;

layout(location = 0) in vec3 inPosOS;
layout(location = 1) in vec3 inNormalWS;
layout(location = 2) in vec4 inTangentWS;
layout(location = 3) in vec2 inUV0;
layout(location = 4) in vec4 inClipNow;
layout(location = 5) in vec4 inClipBefore;

layout(location = 0) out vec4 outAlbedoRoughness;
layout(location = 1) out vec2 outNormal;
layout(location = 2) out vec2 outMotion;
layout(location = 3) out uint outMaterial;

struct Material
{
    vec4 baseColor;
    uint baseColorTexture;
    uint normalTexture;
    uint ormTexture;
    float alphaCutoff;
};

layout(set = 0, binding = 0) uniform sampler2D textures[];
layout(set = 0, binding = 1, std430) readonly buffer Materials { Material materials[]; };

layout(push_constant) uniform PushConstants
{
    mat4 model;
    uint materialId;
    float hashScale;
    uint frame;
    uint padding;
} pc;

vec2 octEncode(vec3 n)
{
    n /= abs(n.x) + abs(n.y) + abs(n.z);
    vec2 wrapped = (1.0 - abs(n.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(n.xy, vec2(0.0)));
    return n.z >= 0.0 ? n.xy : wrapped;
}

float hash2d(vec2 p)
{
    float s = sin(17.0 * p.x + 0.1 * p.y);
    float t = abs(sin(13.0 * p.y + p.x));
    return fract(1e4 * s * (0.1 + t));
}

float hash3d(vec3 p)
{
    return hash2d(vec2(hash2d(p.xy), p.z));
}

// Maps a mix of two independent uniform variates back to a uniform one.
float uniformize(float x, float t)
{
    const float a = min(t, 1.0 - t);
    const float denom = 2.0 * a * (1.0 - a);

    if (x < a) {
        return x * x / denom;
    }
    if (x >= 1.0 - a) {
        const float y = 1.0 - x;
        return 1.0 - y * y / denom;
    }
    return (x - 0.5 * a) / (1.0 - a);
}

float hashedAlphaThreshold(vec3 posOS)
{
    const float footprint = max(length(dFdxFine(posOS)), length(dFdyFine(posOS)));
    const float scale = 1.0 / (pc.hashScale * footprint);
    const float octave = log2(scale);

    const float coarse = hash3d(floor(exp2(floor(octave)) * posOS));
    const float fine   = hash3d(floor(exp2(ceil(octave)) * posOS));
    const float t      = fract(octave);

    return clamp(uniformize(mix(coarse, fine, t), t), 1e-6, 1.0);
}

vec3 shadingNormal(Material m)
{
    vec3 n = normalize(inNormalWS);
    if (HAS_NORMAL_MAP) {
        vec3 t = normalize(inTangentWS.xyz);
        vec3 b = cross(n, t) * inTangentWS.w;
        vec3 s = texture(textures[nonuniformEXT(m.normalTexture)], inUV0).xyz * 2.0 - 1.0;
        n = normalize(mat3(t, b, n) * s);
    }
    return gl_FrontFacing ? n : -n;
}

void main()
{
    Material m = materials[pc.materialId];
    vec4 base = m.baseColor * texture(textures[nonuniformEXT(m.baseColorTexture)], inUV0);

    if (ALPHA_MASKED) {
        if (base.a < hashedAlphaThreshold(inPosOS)) discard;
    }

    vec3 orm = texture(textures[nonuniformEXT(m.ormTexture)], inUV0).rgb;

    outAlbedoRoughness = vec4(base.rgb, max(orm.g, 0.045));
    outNormal = octEncode(shadingNormal(m));
    outMotion = (inClipNow.xy / inClipNow.w - inClipBefore.xy / inClipBefore.w) * 0.5;
    outMaterial = packMaterial(pc.materialId, orm);   // gbuffer_common.glsl
}
