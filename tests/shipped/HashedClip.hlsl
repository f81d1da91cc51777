#ifndef HASHED_CLIP_INCLUDED
#define HASHED_CLIP_INCLUDED

// Custom Function node for Shader Graph. Source: "File", Name: "HashedClip".

float HC_Hash2(float2 p)
{
    return frac(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float HC_Hash3(float3 p)
{
    return HC_Hash2(float2(HC_Hash2(p.xy), p.z));
}

void HashedClip_float(float3 PositionOS, float Alpha, float HashScale, out float Out)
{
#if defined(SHADERGRAPH_PREVIEW)
    Out = Alpha;
#else
    float maxDeriv = max(length(ddx(PositionOS)), length(ddy(PositionOS)));
    float pixScale = rcp(HashScale * maxDeriv);
    float lg = log2(pixScale);
    float2 s = float2(exp2(floor(lg)), exp2(ceil(lg)));
    float2 n = float2(HC_Hash3(floor(s.x * PositionOS)), HC_Hash3(floor(s.y * PositionOS)));
    float w = frac(lg);
    float x = lerp(n.x, n.y, w);
    float a = min(w, 1.0 - w);
    float3 cases = float3(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    float t = (x < 1.0 - a) ? ((x < a) ? cases.x : cases.y) : cases.z;
    t = clamp(t, 1.0e-6, 1.0);
    clip(Alpha - t);
    Out = 1.0;
#endif
}

void HashedClip_half(half3 PositionOS, half Alpha, half HashScale, out half Out)
{
    float o;
    HashedClip_float((float3)PositionOS, (float)Alpha, (float)HashScale, o);
    Out = (half)o;
}

#endif // HASHED_CLIP_INCLUDED
