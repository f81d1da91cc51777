#ifndef FOLIAGE_HASHED_ALPHA_CLIP_INCLUDED
#define FOLIAGE_HASHED_ALPHA_CLIP_INCLUDED

// Für die Blätter: die Schwelle hängt nur an der Position im Objektraum, nicht am Bild.
// (Größe einer Zelle ≈ ein Pixel; siehe Abschnitt 4 bei Wyman & McGuire)

#include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Core.hlsl"
#include "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Lighting.hlsl"

TEXTURE2D(_BaseMap);            SAMPLER(sampler_BaseMap);
TEXTURE2D(_TranslucencyMap);    SAMPLER(sampler_TranslucencyMap);

CBUFFER_START(UnityPerMaterial)
float4 _BaseMap_ST;
half4 _BaseColor;
half _Smoothness;
half _Translucency;
float _HashScale;
float _ObjectScale;
CBUFFER_END

struct Attributes
{
    float4 positionOS : POSITION;
    float3 normalOS   : NORMAL;
    float2 texcoord   : TEXCOORD0;
    UNITY_VERTEX_INPUT_INSTANCE_ID
};

struct Varyings
{
    float2 uv         : TEXCOORD0;
    float3 positionOS : TEXCOORD1;
    half3  normalWS   : TEXCOORD2;
    float4 positionCS : SV_POSITION;
    UNITY_VERTEX_INPUT_INSTANCE_ID
    UNITY_VERTEX_OUTPUT_STEREO
};

float FoliageHash(float2 v)
{
    return frac(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float FoliageHash(float3 v)
{
    return FoliageHash(float2(FoliageHash(v.xy), v.z));
}

// true: the fragment's kept
bool HashedAlphaVisible(half alpha, float3 positionOS)
{
    // instances of other sizes get cells of their own size
    float3 p = positionOS * _ObjectScale;
    float width = max(length(ddx(p)), length(ddy(p)));
    float lod = log2(rcp(_HashScale * width));

    float2 octaves = exp2(float2(floor(lod), ceil(lod)));
    float w = frac(lod);
    float x = lerp(FoliageHash(floor(octaves.x * p)), FoliageHash(floor(octaves.y * p)), w);

    float a = min(w, 1.0 - w);
    float3 cases = float3(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)));
    float threshold = (x < 1.0 - a) ? ((x < a) ? cases.x : cases.y) : cases.z;
    return !(alpha < clamp(threshold, 1.0e-6, 1.0));
}

Varyings FoliageVertex(Attributes input)
{
    Varyings output = (Varyings)0;
    UNITY_SETUP_INSTANCE_ID(input);
    UNITY_TRANSFER_INSTANCE_ID(input, output);
    UNITY_INITIALIZE_VERTEX_OUTPUT_STEREO(output);
    output.uv = TRANSFORM_TEX(input.texcoord, _BaseMap);
    output.positionOS = input.positionOS.xyz;
    output.normalWS = TransformObjectToWorldNormal(input.normalOS);
    output.positionCS = TransformObjectToHClip(input.positionOS.xyz);
    return output;
}

half4 FoliageFragment(Varyings input, half facing : VFACE) : SV_Target
{
    UNITY_SETUP_INSTANCE_ID(input);
    half4 albedo = SAMPLE_TEXTURE2D(_BaseMap, sampler_BaseMap, input.uv) * _BaseColor;
    if (!HashedAlphaVisible(albedo.a, input.positionOS))
        discard;

    Light mainLight = GetMainLight();
    half ndotl = saturate(dot(normalize(input.normalWS) * facing, mainLight.direction));
    half3 through = SAMPLE_TEXTURE2D(_TranslucencyMap, sampler_TranslucencyMap, input.uv).rgb * _Translucency;
    return half4(albedo.rgb * mainLight.color * (ndotl + through), 1.0h);
}

#endif
