//--------------------------------------------------------------------------------------
// FoliagePS.hlsl
//
// fxc /T ps_5_0 /E main /O3 FoliagePS.hlsl
//--------------------------------------------------------------------------------------

#define ALPHA_TEST_OFF    0
#define ALPHA_TEST_FIXED  1
#define ALPHA_TEST_HASHED 2

#ifndef ALPHA_TEST
#define ALPHA_TEST ALPHA_TEST_HASHED
#endif

cbuffer PerFrame : register(b0)
{
    float4x4 g_ViewProj;
    float4x4 g_ShadowMatrix;
    float3   g_SunDirection;
    float    g_SunIntensity;
    float3   g_AmbientSky;
    uint     g_FrameNumber;
    float3   g_AmbientGround;
    float    g_FogDensity;
    float3   g_FogColor;
    float    g_Exposure;
};

cbuffer PerMaterial : register(b1)
{
    float4 g_Tint;
    float  g_AlphaRef;
    float  g_Translucency;
    float  g_NoisePixels;
    float  g_Pad;
};

Texture2D              g_Albedo    : register(t0);
Texture2D              g_Thickness : register(t1);
Texture2D<float>       g_ShadowMap : register(t2);
SamplerState           g_Aniso     : register(s0);
SamplerComparisonState g_Pcf       : register(s1);

struct PSInput
{
    float4 Position  : SV_Position;
    float3 ObjectPos : TEXCOORD0;
    float3 WorldPos  : TEXCOORD1;
    float3 Normal    : NORMAL;
    float2 Tex       : TEXCOORD2;
    float  ViewDepth : TEXCOORD3;
    bool   FrontFace : SV_IsFrontFace;
};

float Hash(float2 n)
{
    return frac(1.0e4 * sin(17.0 * n.x + 0.1 * n.y) * (0.1 + abs(sin(13.0 * n.y + n.x))));
}

float Hash3D(float3 n)
{
    return Hash(float2(Hash(n.xy), n.z));
}

float Shadow(float3 worldPos)
{
    float4 p = mul(float4(worldPos, 1.0f), g_ShadowMatrix);
    float sum = 0.0f;
    [unroll]
    for (int i = 0; i < 4; ++i)
    {
        float2 offset = float2(i & 1, i >> 1) - 0.5f;
        sum += g_ShadowMap.SampleCmpLevelZero(g_Pcf, p.xy + offset / 2048.0f, p.z);
    }
    return sum * 0.25f;
}

float3 Uncharted(float3 x)
{
    const float A = 0.15f, B = 0.50f, C = 0.10f, D = 0.20f, E = 0.02f, F = 0.30f;
    return ((x * (A * x + C * B) + D * E) / (x * (A * x + B) + D * F)) - E / F;
}

float4 main(PSInput input) : SV_Target
{
    float4 color = g_Albedo.Sample(g_Aniso, input.Tex) * g_Tint;
    float thickness = g_Thickness.Sample(g_Aniso, input.Tex).r;

#if ALPHA_TEST == ALPHA_TEST_HASHED
    // Find the discretized derivatives of our coordinates
    float3 objCoord = input.ObjectPos;
    float maxDeriv = max(length(ddx(objCoord)), length(ddy(objCoord)));
    float pixScale = 1.0f / (g_NoisePixels * maxDeriv);

    float2 pixScales = float2(exp2(floor(log2(pixScale))), exp2(ceil(log2(pixScale))));
    float2 alpha = float2(Hash3D(floor(pixScales.x * objCoord)), Hash3D(floor(pixScales.y * objCoord)));
    float lerpFactor = frac(log2(pixScale));

    float x = (1.0f - lerpFactor) * alpha.x + lerpFactor * alpha.y;
    float a = min(lerpFactor, 1.0f - lerpFactor);

    float threshold;
    if (x < 1.0f - a)
    {
        if (x < a)
            threshold = x * x / (2.0f * a * (1.0f - a));
        else
            threshold = (x - 0.5f * a) / (1.0f - a);
    }
    else
    {
        threshold = 1.0f - ((1.0f - x) * (1.0f - x) / (2.0f * a * (1.0f - a)));
    }

    // zero would let everything pass
    threshold = clamp(threshold, 1.0e-6f, 1.0f);

    if (color.a < threshold) discard;
#elif ALPHA_TEST == ALPHA_TEST_FIXED
    clip(color.a - g_AlphaRef);
#endif

    float3 n = normalize(input.FrontFace ? input.Normal : -input.Normal);
    float ndl = dot(n, -g_SunDirection);
    float direct = saturate(ndl) + g_Translucency * (1.0f - thickness) * saturate(-ndl);
    float3 ambient = lerp(g_AmbientGround, g_AmbientSky, n.y * 0.5f + 0.5f);

    float3 lit = color.rgb * (direct * g_SunIntensity * Shadow(input.WorldPos) + ambient);
    lit = lerp(g_FogColor, lit, exp(-g_FogDensity * input.ViewDepth));
    lit = Uncharted(lit * g_Exposure) / Uncharted(11.2f);

    return float4(pow(lit, 1.0f / 2.2f), 1.0f);
}
