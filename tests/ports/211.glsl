// Coverage threshold for the grass cards.

uint jenkins(uvec3 k)
{
    uint h = 0u;
    for (int i = 0; i < 3; i++)
    {
        for (int j = 0; j < 4; j++)
        {
            h += (k[i] >> uint(8 * j)) & 255u;
            h += h << 10;
            h ^= h >> 6;
        }
    }
    h += h << 3;
    h ^= h >> 11;
    h += h << 15;
    return h;
}

float gridNoise(vec3 p)
{
    uvec3 key = uvec3(ivec3(floor(p)));
    return float(jenkins(key) >> 8) * (1.0 / 16777216.0);
}

float threshold(vec3 worldPos)
{
    vec3 step3 = max(abs(dFdx(worldPos)), abs(dFdy(worldPos)));
    vec3 lod = log2(vec3(0.70710678) / step3);

    vec3 s0 = exp2(floor(lod));
    vec3 s1 = exp2(ceil(lod));

    vec3 f = fract(lod);
    float nearLen = length(f);
    float farLen = length(vec3(1.0) - f);
    float w = nearLen / (nearLen + farLen);

    float x = mix(gridNoise(s0 * worldPos), gridNoise(s1 * worldPos), 0.5);

    float a = min(w, 1.0 - w);
    float t = (x - 0.5 * a) / (1.0 - a);
    if (x < a)
        t = x * x / (2.0 * a * (1.0 - a));

    return clamp(t, 1.0e-6, 1.0);
}
