#version 450 core
#extension GL_ARB_shading_language_include : enable

#include "/lib/atmosphere.glsl"
#include "/lib/csm.glsl"

layout(location = 0) in BladeData
{
    vec3 local;          // blade space, x y in [-0.5, 0.5], before bending
    vec3 world;
    vec3 normal;
    vec2 uv;
    flat uint seed;
} blade;

layout(location = 0) out vec4 outColor;

layout(binding = 0) uniform sampler2D uGrass;
layout(binding = 1) uniform sampler2DArrayShadow uCascades;

layout(std140, binding = 2) uniform GrassParams
{
    vec4  dryColor;
    vec4  lushColor;
    float dryness;
    float fadeStart;
    float fadeEnd;
    float hashPixels;
} grass;

layout(std140, binding = 3) uniform View
{
    mat4 viewProj;
    vec4 eye;
    uint frameIndex;
} view;

uint mixBits(uint h)
{
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    h ^= h >> 16;
    return h;
}

float random(ivec3 c)
{
    uint h = mixBits(uint(c.x));
    h = mixBits(h ^ uint(c.y));
    h = mixBits(h ^ uint(c.z));
    return float(h >> 8) / float(1 << 24);
}

float randomSeed(uint seed)
{
    return float(mixBits(seed) & 0xffffu) / 65535.0;
}

void applyAlphaHash(inout vec4 color, vec3 p)
{
    float texel = grass.hashPixels * max(length(dFdx(p)), length(dFdy(p)));
    float l = log2(1.0 / texel);
    vec2 s = exp2(vec2(floor(l), ceil(l)));
    float t = fract(l);

    // our cells are integers already, no need for the sine
    float x = mix(random(ivec3(p * s.x)), random(ivec3(p * s.y)), t);

    float a = min(t, 1.0 - t), b = 1.0 - a;
    float threshold;
    if (x < a)      { threshold = x * x / (2.0 * a * b); }
    else if (x < b) { threshold = (x - a / 2.0) / b; }
    else            { threshold = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * b); }
    threshold = clamp(threshold, 1e-6, 1.0);

    color.a = color.a < threshold ? 0.0 : 1.0;
}

void main()
{
    vec4 color = texture(uGrass, blade.uv);
    float r = randomSeed(blade.seed);
    color.rgb *= mix(grass.lushColor.rgb, grass.dryColor.rgb, clamp(grass.dryness + r - 0.5, 0.0, 1.0));
    color.rgb *= mix(0.4, 1.0, blade.uv.y);       // there's no AO this far out

    float dist = distance(view.eye.xyz, blade.world);
    color.a *= 1.0 - smoothstep(grass.fadeStart, grass.fadeEnd, dist);

    applyAlphaHash(color, blade.local);
    if (color.a == 0.0)
        discard;

    vec3 n = normalize(mix(blade.normal, vec3(0, 1, 0), 0.5));
    float shadow = sampleCascades(uCascades, blade.world);    // csm.glsl
    vec3 lit = color.rgb * (sunLight(n) * shadow + skyLight(n));
    lit = aerialPerspective(lit, view.eye.xyz, blade.world);
    outColor = vec4(lit, 1.0);
}
