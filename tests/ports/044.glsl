// MurmurHash3 (x86, 32 bit) of three cell indices.
uint murmur3(uvec3 words, uint seed)
{
    uint h = seed;
    for (int i = 0; i < 3; ++i)
    {
        uint k = words[i] * 0xcc9e2d51u;
        k = (k << 15) | (k >> 17);
        h ^= k * 0x1b873593u;
        h = (h << 13) | (h >> 19);
        h = h * 5u + 0xe6546b64u;
    }
    h ^= 12u;
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    h ^= h >> 16;
    return h;
}

float noiseOf(vec3 p, uint seed)
{
    uvec3 cell = uvec3(ivec3(floor(p)));
    return float(murmur3(cell, seed) >> 8) / 16777216.0;
}

float threshold(vec3 position, uint frame)
{
    float maxDeriv = max(length(dFdx(position)), length(dFdy(position)));
    float pixScale = 1.0 / max(maxDeriv, 1e-8);
    float l = log2(pixScale);

    float h0 = noiseOf(exp2(floor(l)) * position, frame);
    float h1 = noiseOf(exp2(ceil(l)) * position, frame);

    float w = fract(l);
    float x = (1.0 - w) * h0 + w * h1;

    float a = min(w, 1.0 - w);
    if (x < a)
        x = x * x / (2.0 * a * (1.0 - a));
    else if (x < 1.0 - a)
        x = (x - 0.5 * a) / (1.0 - a);
    else
        x = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    return clamp(x, 1.0e-6, 1.0);
}
