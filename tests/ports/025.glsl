const float SQRT1_2 = 0.70710678;

uint murmurStep(uint h, uint k)
{
    k *= 0xcc9e2d51u;
    k = (k << 15) | (k >> 17);
    k *= 0x1b873593u;
    h ^= k;
    h = (h << 13) | (h >> 19);
    return h * 5u + 0xe6546b64u;
}

uint murmurEnd(uint h, uint len)
{
    h ^= len;
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    return h ^ (h >> 16);
}

float cellNoise(vec3 pos, ivec3 octave)
{
    ivec3 cell = ivec3(floor(pos * exp2(vec3(octave))));
    uint h = 0u;
    for (int i = 0; i < 3; i++)
    {
        h = murmurStep(h, uint(cell[i]));
        h = murmurStep(h, uint(octave[i]));
    }
    return float(murmurEnd(h, 24u) >> 8) * exp2(-24.0);
}

float threshold(vec3 pos)
{
    vec3 d = fwidth(pos);
    vec3 level = log2(SQRT1_2 / max(d, vec3(1e-8)));

    ivec3 lo = ivec3(floor(level));
    float n0 = cellNoise(pos, lo);
    float n1 = cellNoise(pos, lo + 1);

    vec3 f = fract(level);
    float near = length(f), far = length(vec3(1.0) - f);
    float w = near / (near + far);
    float x = mix(n0, n1, w);

    float a = min(w, 1.0 - w);
    float t = x < a ? x * x / (2.0 * a * (1.0 - a))
            : x < 1.0 - a ? (x - 0.5 * a) / (1.0 - a)
            : 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    return clamp(t, 1.0e-6, 1.0);
}
