#version ogre_glsl_ver_330

// Base pass of leaves and needles; the same file serves GL3+, GLES3 and Vulkan.
#include "OgreUnifiedShader.h"

#if HASHED_ALPHA
#define HASH_MAGNITUDE 1.0e4
#define LEVEL_LOW(x)  exp2(floor(log2(x)))
#define LEVEL_HIGH(x) exp2(ceil(log2(x)))
#endif

SAMPLER2D(diffuseMap, 0);
SAMPLER2D(normalMap, 1);
SAMPLER2DSHADOW(shadowMap, 2);

OGRE_UNIFORMS_BEGIN
    uniform vec4 lightDiffuse[NUM_LIGHTS];
    uniform vec4 lightPosition[NUM_LIGHTS];
    uniform vec4 lightAttenuation[NUM_LIGHTS];
    uniform vec4 ambient;
    uniform vec4 fogColour;
    uniform vec4 fogParams;
    uniform float hashScale;
    uniform float alphaRejection;
OGRE_UNIFORMS_END

float hash21(vec2 v)
{
    return fract(HASH_MAGNITUDE * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float hash31(vec3 v)
{
    return hash21(vec2(hash21(v.xy), v.z));
}

float getAlphaThreshold(vec3 objCoord)
{
    float maxDeriv = max(length(dFdx(objCoord)), length(dFdy(objCoord)));
    float pixScale = 1.0 / (hashScale * maxDeriv);
    vec2 pixScales = vec2(LEVEL_LOW(pixScale), LEVEL_HIGH(pixScale));
    vec2 alpha = vec2(hash31(floor(pixScales.x * objCoord)), hash31(floor(pixScales.y * objCoord)));
    float lerpFactor = fract(pixScale);
    float x = (1.0 - lerpFactor) * alpha.x + lerpFactor * alpha.y;
    float a = min(lerpFactor, 1.0 - lerpFactor);
    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    float at = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;
    return clamp(at, 1.0e-6, 1.0);
}

vec3 expandNormal(vec3 n) { return n * 2.0 - 1.0; }

MAIN_PARAMETERS
    IN(vec2 vUv0, TEXCOORD0)
    IN(vec3 vObjectPos, TEXCOORD1)
    IN(vec3 vWorldPos, TEXCOORD2)
    IN(vec3 vNormal, TEXCOORD3)
    IN(vec4 vShadowPos, TEXCOORD4)
    IN(float vDepth, TEXCOORD5)
MAIN_DECLARATION
{
    vec4 albedo = texture2D(diffuseMap, vUv0);

#if HASHED_ALPHA
    if (albedo.a < getAlphaThreshold(vObjectPos))
        discard;
#else
    if (albedo.a < alphaRejection)
        discard;
#endif

    vec3 n = normalize(vNormal);
    if (!gl_FrontFacing)
        n = -n;

    vec3 lit = ambient.rgb;
    for (int i = 0; i < NUM_LIGHTS; ++i)
    {
        vec3 l = lightPosition[i].xyz - vWorldPos * lightPosition[i].w;
        float d = length(l);
        float atten = 1.0 / (lightAttenuation[i].y + lightAttenuation[i].z * d + lightAttenuation[i].w * d * d);
        float shadow = i == 0 ? shadow2DProj(shadowMap, vShadowPos).x : 1.0;
        lit += lightDiffuse[i].rgb * max(dot(n, l / d), 0.0) * atten * shadow;
    }

    vec3 colour = albedo.rgb * lit;
    float fog = saturate((vDepth - fogParams.y) * fogParams.w);
    gl_FragColor = vec4(mix(colour, fogColour.rgb, fog), 1.0);
}
