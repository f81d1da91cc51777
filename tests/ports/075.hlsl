float hash(float2 p)
{
    return frac(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float hash(float3 p)
{
    return hash(float2(hash(p.xy), p.z));
}

float uniformFrom(float x, float w)
{
    float a = min(w, 1.0 - w);
    float3 c;
    c.x = x * x / (2.0 * a * (1.0 - a));
    c.y = (x - 0.5 * a) / (1.0 - a);
    c.z = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    return x < 1.0 - a ? (x < a ? c.x : c.y) : c.z;
}

// hashScale comes from the material and defaults to one.
float getAlphaHashThreshold(float3 position, float hashScale)
{
    float lenX = length(ddx(position));
    float lenY = length(ddy(position));
    float pixScale = 1.0 / max(lenX, lenY);

    float lg = log2(pixScale);
    float s0 = exp2(floor(lg));
    float s1 = exp2(ceil(lg));

    float w = frac(lg);
    float x = (1.0 - w) * hash(floor(s0 * position)) + w * hash(floor(s1 * position));

    return clamp(uniformFrom(x, w), 1.0e-6, 1.0);
}
