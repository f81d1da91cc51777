#pragma once
// AlphaHash.hlsli
// Hashed alpha testing, with an integer hash in place of the sine: the sine of large arguments isn't the same on all
// vendors, and QA compares screenshots.

#include "Globals.hlsli"
#include "MaterialConstants.hlsli"

#ifndef ALPHA_HASH_REGISTER
#define ALPHA_HASH_REGISTER b5
#endif

cbuffer AlphaHashConstants : register(ALPHA_HASH_REGISTER)
{
    float  g_hashScale;         // [UI] "Noise size (px)" range(0.25, 4) default(1)
    uint   g_frameIndex;
    float2 g_taaJitter;
    float4 g_debugTint;
};

Texture2D<float4> g_debugHeat : register(t31);
SamplerState g_linearClamp    : register(s7);

// ---------------------------------------------------------------------------------------------------------------------

uint Avalanche(uint h)
{
    h ^= h >> 16;
    h *= 0x85ebca6b;
    h ^= h >> 13;
    h *= 0xc2b2ae35;
    h ^= h >> 16;
    return h;
}

float HashCell(float3 cell)
{
    // The indices stay floats up to here, and it's their bits that are hashed: far out a cast to int would saturate.
    uint3 bits = asuint(cell + 0.0); // -0 and 0 are one cell
    uint h = Avalanche(bits.x + 0x9e3779b9);
    h = Avalanche(h ^ bits.y);
    h = Avalanche(h + 0x7f4a7c15 ^ bits.z);
    return (h >> 8) * (1.0 / 16777216.0);
}

float ComputeHashedThreshold(float3 objectPos)
{
    float3 dx = ddx(objectPos);
    float3 dy = ddy(objectPos);
    float maxDeriv = sqrt(max(dot(dx, dx), dot(dy, dy)));

    float pixScale = rcp(g_hashScale * maxDeriv);
    float level    = log2(pixScale);
    float floorL   = floor(level);
    float t        = level - floorL;

    float2 h;
    h.x = HashCell(floor(objectPos * exp2(floorL)));
    h.y = HashCell(floor(objectPos * exp2(floorL + 1)));

    float x = lerp(h.x, h.y, t);
    float a = min(t, 1 - t);

    [branch]
    if (x < a)
        x = x * x / (2 * a * (1 - a));
    else if (x < 1 - a)
        x = (x - 0.5 * a) / (1 - a);
    else
        x = 1 - (1 - x) * (1 - x) / (2 * a * (1 - a));

    return clamp(x, 1e-6, 1);
}

// Heat map for the "Show alpha hash" view mode
float4 DebugAlphaHash(float3 objectPos, float alpha)
{
    float t = ComputeHashedThreshold(objectPos);
    float4 heat = g_debugHeat.SampleLevel(g_linearClamp, float2(t, 0.5), 0);
    return alpha < t ? g_debugTint : heat;
}
