// Terrain cover (grass patches), Ogre 1.x, ps_4_0
// params in the material: param_named hashScale float 1.0

#include "FFPLib_Fog.hlsl"
#include "SGXLib_PerPixelLighting.hlsl"

Texture2D coverMap : register(t0);
SamplerState coverSampler : register(s0);
Texture2D shadowMap : register(t1);
SamplerComparisonState shadowSampler : register(s1);

cbuffer Params : register(b0)
{
    float  hashScale;
    float  fadeRange;
    float4 sunDir;
    float4 sunColour;
};

struct CoverFragment
{
    float3 objectPos : TEXCOORD0;
    float3 worldPos  : TEXCOORD1;
    float2 uv        : TEXCOORD2;
    float  fade      : TEXCOORD3;
};

struct CoverResult
{
    float threshold;
    float octave;
    bool  kept;
};

float Hash2(float2 v)
{
    return frac(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float Hash3(float3 v)
{
    return Hash2(float2(Hash2(v.xy), v.z));
}

void CoverTest(in float3 objectPos, in float alpha, out CoverResult result)
{
    float3 dx = ddx(objectPos);
    float3 dy = ddy(objectPos);
    // one square root would be wasted on each, so take the larger first
    float maxDeriv = max(dot(dx, dx), dot(dy, dy));
    float pixScale = 1.0 / (hashScale * maxDeriv);

    result.octave = log2(pixScale);
    float2 scales = float2(exp2(floor(result.octave)), exp2(ceil(result.octave)));
    float2 noise = float2(Hash3(floor(scales.x * objectPos)), Hash3(floor(scales.y * objectPos)));

    float f = frac(result.octave);
    float x = lerp(noise.x, noise.y, f);
    float a = min(f, 1.0 - f);
    float3 cases = float3(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    float t = (x < 1.0 - a) ? ((x < a) ? cases.x : cases.y) : cases.z;
    result.threshold = clamp(t, 1.0e-6, 1.0);
    result.kept = alpha >= result.threshold;
}

float SampleShadow(float4 lightPos)
{
    float3 p = lightPos.xyz / lightPos.w;
    return shadowMap.SampleCmpLevelZero(shadowSampler, p.xy, p.z - 0.001);
}

float4 main_ps(CoverFragment i) : SV_Target
{
    float4 c = coverMap.Sample(coverSampler, i.uv);
    CoverResult r;
    CoverTest(i.objectPos, c.a * saturate(i.fade / fadeRange), r);
    if (!r.kept)
        discard;
    float3 lit = c.rgb * sunColour.rgb * saturate(sunDir.y);
    return float4(lit, 1.0);
}
