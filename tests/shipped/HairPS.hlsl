//*********************************************************
//
// Hair sample: order-independent strands by hashed alpha.
// THE SOURCE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND
//
//*********************************************************

cbuffer SceneConstantBuffer : register(b0)
{
    float4x4 worldViewProj;
    float4x4 lightViewProj;
    float4   lightDirection;
    float4   cameraPosition;
};

cbuffer HairConstantBuffer : register(b1)
{
    float4 hairColor;
    float  hashScale;
    float  strandWidth;
    float2 padding;
};

Texture2D    g_alphaTexture : register(t0);
Texture2D<float> g_shadowMap : register(t1);
SamplerState g_sampler      : register(s0);

struct PSInput
{
    float4 position    : SV_POSITION;
    float3 objectPos   : POSITION1;
    float3 tangent     : TANGENT;
    float2 uv          : TEXCOORD;
};

struct PSOutput
{
    float4 color : SV_TARGET0;
    float4 motion : SV_TARGET1;
};

float Hash(float2 v)
{
    return frac(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float Hash(float3 v)
{
    return Hash(float2(Hash(v.xy), v.z));
}

static const int kOctaves = 2;

// With a scale of the caller's
float AlphaThreshold(float3 objectPos, float scale)
{
    float width = max(length(ddx(objectPos)), length(ddy(objectPos)));
    float level = log2(1.0 / (scale * width));
    float base = floor(level);
    float f = level - base;

    float weight[kOctaves] = { 1.0 - f, f };
    float x = 0.0;
    [unroll]
    for (int i = 0; i < kOctaves; ++i)
    {
        float cells = exp2(base + (float)i);
        x += weight[i] * Hash(floor(cells * objectPos));
    }

    float a = min(f, 1.0 - f);
    float q = 2.0 * a * (1.0 - a);
    float t;
    if (x >= 1.0 - a)
        t = 1.0 - (1.0 - x) * (1.0 - x) / q;
    else if (x >= a)
        t = (x - 0.5 * a) / (1.0 - a);
    else
        t = x * x / q;
    return clamp(t, 1.0e-6, 1.0);
}

// With the scale of the constant buffer
float AlphaThreshold(float3 objectPos)
{
    return AlphaThreshold(objectPos, hashScale);
}

float3 KajiyaKay(float3 tangent, float3 viewDir, float3 lightDir)
{
    float tl = dot(tangent, lightDir);
    float tv = dot(tangent, viewDir);
    float spec = pow(saturate(sqrt(1.0 - tl * tl) * sqrt(1.0 - tv * tv) - tl * tv), 32.0);
    return hairColor.rgb * sqrt(saturate(1.0 - tl * tl)) + spec;
}

PSOutput PSMain(PSInput input)
{
    PSOutput output;
    float alpha = g_alphaTexture.Sample(g_sampler, input.uv).r * hairColor.a;
    if (alpha < AlphaThreshold(input.objectPos))
    {
        discard;
    }
    float3 v = normalize(cameraPosition.xyz - input.objectPos);
    output.color = float4(KajiyaKay(normalize(input.tangent), v, -lightDirection.xyz), 1.0);
    output.motion = 0;
    return output;
}
