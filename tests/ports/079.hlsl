float SinHash(float2 v)
{
    return frac(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float SinHash3(float3 v)
{
    float xy = SinHash(v.xy);
    return SinHash(float2(xy, v.z));
}

float NoiseAt(float3 p, float octave)
{
    return SinHash3(p * exp2(octave));
}

float threshold(float3 pos, float hash_scale)
{
    float2 lens = float2(length(ddx(pos)), length(ddy(pos)));
    float maxDeriv = max(lens.x, lens.y);
    float pixScale = 2.0 / (hash_scale * maxDeriv);

    float level = log2(pixScale);
    float below = NoiseAt(pos, floor(level));
    float above = NoiseAt(pos, ceil(level));

    float w = frac(level);
    float x = lerp(below, above, w);

    float a = min(w, 1.0 - w);
    float denom = 2.0 * a * (1.0 - a);
    float t = (x - 0.5 * a) / (1.0 - a);
    if (x < a)
    {
        t = (x * x) / denom;
    }
    else if (x >= 1.0 - a)
    {
        t = 1.0 - (1.0 - x) * (1.0 - x) / denom;
    }
    return clamp(t, 1.0e-6, 1.0);
}
