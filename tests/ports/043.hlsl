static const float HASH_SCALE = 1.0;

float hash2(float2 c)
{
    float s = sin(17.0 * c.x + 0.1 * c.y);
    float t = abs(sin(13.0 * c.y + c.x)) + 0.1;
    return frac(1.0e4 * s * t);
}

float hash3(float3 c)
{
    return hash2(float2(hash2(c.xy), c.z));
}

float threshold(float3 position)
{
    float dX = length(ddx(position));
    float dY = length(ddy(position));
    float scale = 1.0 / (HASH_SCALE * max(dX, dY));

    float lower = exp2(floor(log2(scale)));
    float upper = exp2(ceil(log2(scale)));

    float2 h = float2(hash3(lower * position), hash3(upper * position));

    float f = frac(log2(scale));
    float x = h.x * (1.0 - f) + h.y * f;

    // Eq. 2
    float a = min(f, 1.0 - f);
    float t = 0.0;
    if (x < a)
    {
        t = x * x / (2.0 * a * (1.0 - a));
    }
    else if (x < 1.0 - a)
    {
        t = (x - 0.5 * a) / (1.0 - a);
    }
    else
    {
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    }
    return clamp(t, 1.0e-6, 1.0);
}
