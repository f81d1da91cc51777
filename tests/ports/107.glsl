uint hash3u(uvec3 x)
{
    const uint k = 1103515245u;
    x = ((x >> 8u) ^ x.yzx) * k;
    x = ((x >> 8u) ^ x.yzx) * k;
    x = ((x >> 8u) ^ x.yzx) * k;
    return x.x;
}

float cellNoise(vec3 p, int octave)
{
    ivec3 cell = ivec3(floor(p * exp2(float(octave))));
    // a different lattice for every octave
    uvec3 key = uvec3(cell) + uint(octave) * uvec3(0x9e3779b9u, 0x7f4a7c15u, 0x85ebca6bu);
    return float(hash3u(key) >> 8u) / 16777216.0;
}

float threshold(vec3 position, vec3 dpdx, vec3 dpdy, float hash_scale)
{
    float d = hash_scale * max(length(dpdx), length(dpdy));
    float level = log2(1.0 / d);
    int o = int(floor(level));
    float f = fract(level);

    float n0 = cellNoise(position, o);
    float n1 = cellNoise(position, o + 1);
    float x = f * n1 + (1.0 - f) * n0;

    float a = min(f, 1.0 - f);
    float t;
    if (x < a)
    {
        t = 0.5 * x * x / (a * (1.0 - a));
    }
    else if (x < 1.0 - a)
    {
        t = (x - 0.5 * a) / (1.0 - a);
    }
    else
    {
        float y = 1.0 - x;
        t = 1.0 - 0.5 * y * y / (a * (1.0 - a));
    }
    return clamp(t, 1.0e-6, 1.0);
}
