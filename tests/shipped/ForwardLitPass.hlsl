#ifndef VEGETATION_FORWARD_LIT_PASS_INCLUDED
#define VEGETATION_FORWARD_LIT_PASS_INCLUDED

// Keywords: _ALPHAHASH_ON _ALPHATEST_ON _NORMALMAP, plus the pipeline's own

#include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Core.hlsl"
#include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Lighting.hlsl"
#include "VegetationInput.hlsl"

TEXTURE2D(_BaseMap);        SAMPLER(sampler_BaseMap);
TEXTURE2D(_TranslucencyMap);SAMPLER(sampler_TranslucencyMap);

CBUFFER_START(UnityPerMaterial)
    float4 _BaseMap_ST;
    half4  _BaseColor;
    half   _Cutoff;
    half   _Smoothness;
    half   _Translucency;
    float  _HashScale;
CBUFFER_END

struct Attributes
{
    float4 positionOS : POSITION;
    float3 normalOS   : NORMAL;
    float2 texcoord   : TEXCOORD0;
    half4  color      : COLOR;
    UNITY_VERTEX_INPUT_INSTANCE_ID
};

struct Varyings
{
    float4 positionCS : SV_POSITION;
    float3 positionWS : TEXCOORD0;
    half3  normalWS   : TEXCOORD1;
    float2 uv         : TEXCOORD2;
    float3 positionOS : TEXCOORD3;
    half   fogFactor  : TEXCOORD4;
    UNITY_VERTEX_INPUT_INSTANCE_ID
    UNITY_VERTEX_OUTPUT_STEREO
};

float Noise2(float2 v)
{
    return frac(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float Noise3(float3 v)
{
    return Noise2(float2(Noise2(v.xy), v.z));
}

half HashedCutoff(float3 positionOS)
{
    float texel = max(length(ddx(positionOS)), length(ddy(positionOS)));
    float pixScale = 1.0 / (_HashScale * texel);

    float logScale = log2(pixScale);
    float scaleLo = exp2(ceil(logScale));
    float scaleHi = exp2(ceil(logScale));

    float lo = Noise3(floor(scaleLo * positionOS));
    float hi = Noise3(floor(scaleHi * positionOS));
    float w = frac(logScale);
    float x = lerp(lo, hi, w);

    float a = min(w, 1.0 - w);
    float3 cases = float3(x * x / (2.0 * a * (1.0 - a)),
                          (x - 0.5 * a) / (1.0 - a),
                          1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    float t = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;

    return clamp(t, 1.0e-6, 1.0);
}

Varyings LitVertex(Attributes input)
{
    Varyings output = (Varyings)0;
    UNITY_SETUP_INSTANCE_ID(input);
    UNITY_TRANSFER_INSTANCE_ID(input, output);
    UNITY_INITIALIZE_VERTEX_OUTPUT_STEREO(output);

    output.positionOS = input.positionOS.xyz;   // unbent, it's what the hash wants
    output.positionWS = BendVegetation(TransformObjectToWorld(input.positionOS.xyz), input.color);
    output.positionCS = TransformWorldToHClip(output.positionWS);
    output.normalWS   = TransformObjectToWorldNormal(input.normalOS);
    output.uv         = TRANSFORM_TEX(input.texcoord, _BaseMap);
    output.fogFactor  = ComputeFogFactor(output.positionCS.z);
    return output;
}

half4 LitFragment(Varyings input, FRONT_FACE_TYPE face : FRONT_FACE_SEMANTIC) : SV_Target
{
    UNITY_SETUP_INSTANCE_ID(input);

    half4 albedo = SAMPLE_TEXTURE2D(_BaseMap, sampler_BaseMap, input.uv) * _BaseColor;

#if defined(_ALPHAHASH_ON)
    clip(albedo.a - HashedCutoff(input.positionOS));
#elif defined(_ALPHATEST_ON)
    clip(albedo.a - _Cutoff);
#endif

    half3 n = normalize(input.normalWS) * IS_FRONT_VFACE(face, 1.0, -1.0);
    Light mainLight = GetMainLight(TransformWorldToShadowCoord(input.positionWS));
    half ndl = dot(n, mainLight.direction);
    half back = SAMPLE_TEXTURE2D(_TranslucencyMap, sampler_TranslucencyMap, input.uv).r * _Translucency;

    half3 color = albedo.rgb * mainLight.color * mainLight.shadowAttenuation * (saturate(ndl) + back * saturate(-ndl));
    color += albedo.rgb * SampleSH(n);
    color = MixFog(color, input.fogFactor);
    return half4(color, 1.0h);
}

#endif
