// The fragment shader of the viewer: metallic-roughness, punctual lights, alpha modes.
precision highp float;

#include <tonemapping.glsl>
#include <textures.glsl>
#include <functions.glsl>
#include <brdf.glsl>
#include <punctual.glsl>
#include <ibl.glsl>
#include <material_info.glsl>

in vec3 v_Position;
in vec3 v_ObjectPosition;
#ifdef HAS_NORMAL_VEC3
in vec3 v_Normal;
#endif
in vec2 v_texcoord_0;

out vec4 g_finalColor;

uniform int u_LightCount;
uniform vec3 u_Camera;
uniform float u_AlphaCutoff;
uniform float u_HashScale;

#ifdef ALPHAMODE_HASH
float hash(vec2 p)
{
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

// Threshold of the alpha mode HASH of an extension.
float getAlphaHash(vec3 p)
{
    float pixelScale = 1.0 / (u_HashScale * max(length(dFdx(p)), length(dFdy(p))));
    float level = log2(pixelScale);
    float coarse = hash(floor(exp2(floor(level)) * p.xy));
    float fine = hash(floor(exp2(ceil(level)) * p.xy));
    float t = fract(level);
    float x = mix(coarse, fine, t);
    float a = min(t, 1.0 - t);
    float b = 1.0 - a;
    float threshold;
    if (x < a)
    {
        threshold = x * x / (2.0 * a * b);
    }
    else if (x < b)
    {
        threshold = (x - 0.5 * a) / b;
    }
    else
    {
        threshold = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * b);
    }
    return clamp(threshold, 1.0e-6, 1.0);
}
#endif

void main()
{
    vec4 baseColor = getBaseColor();

#ifdef ALPHAMODE_OPAQUE
    baseColor.a = 1.0;
#endif

#ifdef ALPHAMODE_MASK
    if (baseColor.a < u_AlphaCutoff)
    {
        discard;
    }
    baseColor.a = 1.0;
#endif

#ifdef ALPHAMODE_HASH
    if (baseColor.a < getAlphaHash(v_ObjectPosition))
    {
        discard;
    }
    baseColor.a = 1.0;
#endif

    vec3 v = normalize(u_Camera - v_Position);
    NormalInfo normalInfo = getNormalInfo(v);
    vec3 n = normalInfo.n;

    MaterialInfo materialInfo;
    materialInfo.baseColor = baseColor.rgb;
    materialInfo.ior = 1.5;
    materialInfo.f0_dielectric = vec3(0.04);
#ifdef MATERIAL_METALLICROUGHNESS
    materialInfo = getMetallicRoughnessInfo(materialInfo);
#endif
    materialInfo.perceptualRoughness = clamp(materialInfo.perceptualRoughness, 0.0, 1.0);
    materialInfo.alphaRoughness = materialInfo.perceptualRoughness * materialInfo.perceptualRoughness;

    vec3 color = vec3(0.0);
#ifdef USE_IBL
    color += getDiffuseLight(n) * baseColor.rgb;
#endif

#ifdef USE_PUNCTUAL
    for (int i = 0; i < LIGHT_COUNT; ++i)
    {
        Light light = u_Lights[i];
        vec3 pointToLight;
        if (light.type != LightType_Directional)
        {
            pointToLight = light.position - v_Position;
        }
        else
        {
            pointToLight = -light.direction;
        }
        vec3 l = normalize(pointToLight);
        float NdotL = clampedDot(n, l);
        color += getLighIntensity(light, pointToLight) * NdotL * BRDF_lambertian(baseColor.rgb);
    }
#endif

#ifdef LINEAR_OUTPUT
    g_finalColor = vec4(color.rgb, baseColor.a);
#else
    g_finalColor = vec4(toneMap(color), baseColor.a);
#endif
}
