#ifndef MEADOW_LIT_SHADOW_CASTER_PASS_INCLUDED
#define MEADOW_LIT_SHADOW_CASTER_PASS_INCLUDED

#include "Packages/com.unity.render-pipelines.core/ShaderLibrary/Common.hlsl"
#include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Core.hlsl"
#include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Shadows.hlsl"
#if defined(LOD_FADE_CROSSFADE)
    #include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/LODCrossFade.hlsl"
#endif

// Shadow casting light geometric parameters.
float3 _LightDirection;
float3 _LightPosition;

TEXTURE2D(_BaseMap);
SAMPLER(sampler_BaseMap);

CBUFFER_START(UnityPerMaterial)
float4 _BaseMap_ST;
half4 _BaseColor;
half _Cutoff;
half _HashScale;
CBUFFER_END

struct Attributes
{
    float4 positionOS   : POSITION;
    float3 normalOS     : NORMAL;
    float2 texcoord     : TEXCOORD0;
    UNITY_VERTEX_INPUT_INSTANCE_ID
};

struct Varyings
{
#if defined(_ALPHATEST_ON)
    float2 uv           : TEXCOORD0;
#endif
    float3 positionOS   : TEXCOORD1;
    float4 positionCS   : SV_POSITION;
    UNITY_VERTEX_INPUT_INSTANCE_ID
};

float Hash12(float2 p)
{
    return frac(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float Hash13(float3 p)
{
    return Hash12(float2(Hash12(p.xy), p.z));
}

half AlphaHashThreshold(float3 p)
{
    float deriv = max(length(ddx(p)), length(ddy(p)));
    float scale = 1.0 / (_HashScale * deriv);
    float lod = log2(scale);
    float lo = exp2(floor(lod));
    float hi = exp2(floor(lod));
    half2 h = half2(Hash13(floor(lo * p)), Hash13(floor(hi * p)));

    half t = frac(lod);
    half x = lerp(h.x, h.y, t);
    half a = min(t, 1.0h - t);
    half k = 2.0h * a * (1.0h - a);

    half result;
    if (x < a)
        result = x * x / k;
    else if (x < 1.0h - a)
        result = (x - 0.5h * a) / (1.0h - a);
    else
        result = 1.0h - (1.0h - x) * (1.0h - x) / k;
    return clamp(result, 1.0e-6h, 1.0h);
}

float4 GetShadowPositionHClip(Attributes input)
{
    float3 positionWS = TransformObjectToWorld(input.positionOS.xyz);
    float3 normalWS = TransformObjectToWorldNormal(input.normalOS);

#if _CASTING_PUNCTUAL_LIGHT_SHADOW
    float3 lightDirectionWS = normalize(_LightPosition - positionWS);
#else
    float3 lightDirectionWS = _LightDirection;
#endif

    float4 positionCS = TransformWorldToHClip(ApplyShadowBias(positionWS, normalWS, lightDirectionWS));
#if UNITY_REVERSED_Z
    positionCS.z = min(positionCS.z, UNITY_NEAR_CLIP_VALUE);
#else
    positionCS.z = max(positionCS.z, UNITY_NEAR_CLIP_VALUE);
#endif
    return positionCS;
}

Varyings ShadowPassVertex(Attributes input)
{
    Varyings output;
    UNITY_SETUP_INSTANCE_ID(input);
    UNITY_TRANSFER_INSTANCE_ID(input, output);
#if defined(_ALPHATEST_ON)
    output.uv = TRANSFORM_TEX(input.texcoord, _BaseMap);
#endif
    output.positionOS = input.positionOS.xyz;
    output.positionCS = GetShadowPositionHClip(input);
    return output;
}

half4 ShadowPassFragment(Varyings input) : SV_TARGET
{
    UNITY_SETUP_INSTANCE_ID(input);

#if defined(_ALPHATEST_ON)
    half alpha = SAMPLE_TEXTURE2D(_BaseMap, sampler_BaseMap, input.uv).a * _BaseColor.a;
    half threshold = AlphaHashThreshold(input.positionOS);
    if (alpha < threshold)
        discard;
#endif

#if defined(LOD_FADE_CROSSFADE)
    LODFadeCrossFade(input.positionCS);
#endif
    return 0;
}

#endif
