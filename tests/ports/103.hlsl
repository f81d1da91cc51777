// Murmur over the cell and the bits of its scale.
uint Rotl(uint v, uint r)
{
    return (v << r) | (v >> (32u - r));
}

uint Absorb(uint h, uint k)
{
    k *= 0xcc9e2d51u;
    k = Rotl(k, 15u);
    k *= 0x1b873593u;
    h = Rotl(h ^ k, 13u);
    return h * 5u + 0xe6546b64u;
}

uint Squeeze(uint h)
{
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    return h ^ (h >> 16);
}

float Noise(float3 p, float scale)
{
    uint3 c = asuint(int3(floor(p * scale)));
    uint h = Absorb(Absorb(Absorb(Absorb(0u, c.x), c.y), c.z), asuint(scale));
    return (Squeeze(h ^ 16u) >> 8) / 16777216.0;
}

float HashedAlpha(float3 position, float hash_scale)
{
    float maxDeriv = max(length(ddx(position)), length(ddy(position)));
    float level = log2(1.0 / (hash_scale * maxDeriv));
    float lo = exp2(floor(level));
    float w = frac(level);

    float x = lerp(Noise(position, lo), Noise(position, lo * 2.0), w);

    float a = min(w, 1.0 - w);
    float k = 2.0 * a * (1.0 - a);
    float t;
    if (x < a)
        t = x * x / k;
    else if (x < 1.0 - a)
        t = (x - 0.5 * a) / (1.0 - a);
    else
        t = 1.0 - (1.0 - x) * (1.0 - x) / k;
    return clamp(t, 1.0e-6, 1.0);
}
