static const float HASH_SCALE = 1.0f;

uint Mix32(uint h)
{
    h ^= h >> 16;
    h *= 0x21f0aaadu;
    h ^= h >> 15;
    h *= 0x735a2d97u;
    h ^= h >> 15;
    return h;
}

float CellValue(float3 p)
{
    int3 c = int3(floor(p));
    uint h = Mix32(uint(c.x));
    h = Mix32(h + uint(c.y));
    h = Mix32(h + uint(c.z));
    return float(h >> 8) / 16777216.0f;
}

float GetAlphaThreshold(float3 worldPos)
{
    float dX = length(ddx(worldPos));
    float dY = length(ddy(worldPos));
    float level = log2(1.0f / (HASH_SCALE * max(dX, dY)));

    float below = CellValue(worldPos * exp2(floor(level)));
    float above = CellValue(worldPos * exp2(ceil(level)));
    float x = lerp(below, above, frac(level));

    // back to a uniform distribution
    float t = 2.0f * x * x;
    if (x >= 0.5f)
        t = 1.0f - 2.0f * (1.0f - x) * (1.0f - x);

    return clamp(t, 1.0e-6f, 1.0f);
}
