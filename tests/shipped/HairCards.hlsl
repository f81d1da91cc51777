// HairCards.hlsl - cards with stochastic transparency, anisotropic variant (cards are long and thin, and seen at all angles)
// Entry points: HairVS, HairPS, HairShadowPS

#include "Common/View.hlsl"
#include "Common/HairBsdf.hlsl"

#define HAIR_NOISE_PIXELS 1.0
#define HAIR_EPSILON      1e-6

cbuffer HairMaterial : register(b2)
{
    float3 RootColor;
    float  Roughness;
    float3 TipColor;
    float  Shift;
    float  OpacityScale;
    float  Unused0, Unused1, Unused2;
};

Texture2D CardTexture : register(t0); // r: opacity, g: id, b: root to tip, a: depth
SamplerState CardSampler : register(s0);

struct VSInput
{
    float3 Position : POSITION;
    float3 Normal   : NORMAL;
    float4 Tangent  : TANGENT;
    float2 UV       : TEXCOORD0;
};

struct VSOutput
{
    float4 ClipPosition : SV_Position;
    float3 LocalPos     : TEXCOORD0;
    float3 WorldPos     : TEXCOORD1;
    float3 Normal       : TEXCOORD2;
    float3 Tangent      : TEXCOORD3;
    float2 UV           : TEXCOORD4;
};

VSOutput HairVS(VSInput v)
{
    VSOutput o;
    o.LocalPos = v.Position;
    o.WorldPos = mul(View.LocalToWorld, float4(v.Position, 1)).xyz;
    o.ClipPosition = mul(View.WorldToClip, float4(o.WorldPos, 1));
    o.Normal = mul((float3x3)View.LocalToWorld, v.Normal);
    o.Tangent = mul((float3x3)View.LocalToWorld, v.Tangent.xyz);
    o.UV = v.UV;
    return o;
}

float HairHash(float2 p)
{
    return frac(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float HairHash(float3 p)
{
    return HairHash(float2(HairHash(p.xy), p.z));
}

float AlphaHashThreshold(VSOutput i)
{
    float3 p = i.LocalPos;

    // per axis instead of the longest
    float3 anisoDeriv  = max(abs(ddx(p)), abs(ddy(p)));
    float3 anisoScales = 0.707 / (HAIR_NOISE_PIXELS * anisoDeriv);

    float3 logScales = log2(anisoScales);
    float3 scaleFlr  = exp2(floor(logScales));
    float3 scaleCeil = exp2(ceil(logScales));
    float2 noise = float2(HairHash(floor(scaleFlr * p)), HairHash(floor(scaleCeil * p)));

    float3 fractLoc = logScales - floor(logScales);
    float toFlr  = length(fractLoc);
    float toCeil = length(1.0 - fractLoc);
    float lerpFactor = toFlr / (toFlr + toCeil);

    float x = lerp(noise.x, noise.y, lerpFactor);

    float a = min(lerpFactor, 1.0 - lerpFactor);
    float ab2 = 2.0 * a * (1.0 - a);
    float t;
    [flatten]
    if (x < a)
    {
        t = x * x / ab2;
    }
    else
    {
        [flatten]
        if (x < 1.0 - a)
            t = (x - 0.5 * a) / (1.0 - a);
        else
            t = 1.0 - (1.0 - x) * (1.0 - x) / ab2;
    }
    return clamp(t, HAIR_EPSILON, 1.0);
}

void HairShadowPS(VSOutput i)
{
    // no noise in the shadow map, it's filtered
    clip(CardTexture.Sample(CardSampler, i.UV).r * OpacityScale - 0.33);
}

float4 HairPS(VSOutput i) : SV_Target0
{
    float4 card = CardTexture.Sample(CardSampler, i.UV);
    float opacity = saturate(card.r * OpacityScale);

    float threshold = AlphaHashThreshold(i);
    if (opacity < threshold)
        discard;

    float3 albedo = lerp(RootColor, TipColor, card.b);
    float3 v = normalize(View.Eye - i.WorldPos);
    float3 color = 0;

    for (uint k = 0; k < View.LightCount; ++k)
        color += HairBsdf(albedo, Roughness, Shift + card.g * 0.1, normalize(i.Tangent), v, View.Lights[k]);

    return float4(color * View.PreExposure, 1);
}
