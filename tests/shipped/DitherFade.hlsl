// Cross-fades and see-through for characters between camera and player.
// Material editor:
//   @property(group="Fade", name="Radius", min=0, max=10) fadeRadius
//   @property(group="Fade", name="Grain",  min=0.5, max=4) fadeGrain

#include "shared/transforms.hlsl"
#include "shared/brdf.hlsl"

struct FadeParams
{
    float3 playerPos;
    float  fadeRadius;
    float  fadeGrain;
    float  minOpacity;
    uint   frame;
    uint   flags;
};

ConstantBuffer<FadeParams> fadeParams : register(b3, space1);
Texture2D<float4> albedoMap : register(t0, space2);
Texture2D<float4> normalMap : register(t1, space2);
SamplerState wrapSampler : register(s0);

#define MOD2(v) frac(1.0e4 * sin(17.0 * (v).x + 0.1 * (v).y) * (0.1 + abs(sin(13.0 * (v).y + (v).x))))
static const float kGrain = 1.0;

float Hash(float3 p)
{
    float2 q = float2(MOD2(p.xy), p.z);
    return MOD2(q);
}

float PlayerFade(float3 positionWS, float3 eye)
{
    float3 toPlayer = fadeParams.playerPos - eye;
    float along = saturate(dot(positionWS - eye, toPlayer) / dot(toPlayer, toPlayer));
    float dist = distance(positionWS, eye + along * toPlayer);
    return max(smoothstep(0.5, 1.0, dist / fadeParams.fadeRadius), fadeParams.minOpacity);
}

// Leaves alpha at 0 or 1. Opaque blending doesn't care, and MSAA resolves it.
void ApplyHashedAlpha(inout float alpha, float3 pos)
{
    float3 px = ddx_fine(pos);
    float3 py = ddy_fine(pos);
    float inv = 1.0 / (kGrain * max(length(px), length(py)));

    float e = log2(inv);
    float lo = floor(e);
    float w = e - lo;
    float s = exp2(lo);

    float x = Hash(floor(s * pos)) * (1.0 - w) + Hash(floor(2.0 * s * pos)) * w;

    float a = min(w, 1.0 - w);
    float denom = 2.0 * a * (1.0 - a);
    float tau;
    if (x < a)
        tau = x * x / denom;
    else if (x <= 1.0 - a)
        tau = (x - 0.5 * a) / (1.0 - a);
    else
        tau = 1.0 - (1.0 - x) * (1.0 - x) / denom;

    alpha = alpha >= clamp(tau, 1.0e-6, 1.0) ? 1.0 : 0.0;
}

struct PSIn
{
    float4 sv       : SV_Position;
    float3 localPos : LOCALPOS;
    float3 worldPos : WORLDPOS;
    float3 normal   : NORMAL;
    float4 tangent  : TANGENT;
    float2 uv       : TEXCOORD0;
};

struct PSOut
{
    float4 color  : SV_Target0;
    float2 motion : SV_Target1;
};

PSOut main(PSIn i, bool front : SV_IsFrontFace)
{
    float4 albedo = albedoMap.Sample(wrapSampler, i.uv);
    float alpha = albedo.a * PlayerFade(i.worldPos, GetEyePosition());

    ApplyHashedAlpha(alpha, i.localPos);
    if (alpha == 0.0)
        discard;

    float3 n = TangentToWorld(normalMap.Sample(wrapSampler, i.uv).xyz * 2.0 - 1.0, i.normal, i.tangent);
    PSOut o;
    o.color = float4(EvaluateBrdf(albedo.rgb, front ? n : -n, i.worldPos), alpha);
    o.motion = GetMotion(i.sv);
    return o;
}
