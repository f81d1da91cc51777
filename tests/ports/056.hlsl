// Wang hash: cheap and good enough for dither.
uint Wang(uint seed)
{
    seed = (seed ^ 61u) ^ (seed >> 16);
    seed *= 9u;
    seed = seed ^ (seed >> 4);
    seed *= 0x27d4eb2du;
    seed = seed ^ (seed >> 15);
    return seed;
}

float CellRandom(float3 cell)
{
    int3 i = int3(cell);
    uint key = uint(i.x ^ i.y ^ i.z);
    return float(Wang(key) >> 8) / 16777216.0;
}

float Cdf(float x, float w)
{
    float a = min(w, 1.0 - w);
    float k = 2.0 * a * (1.0 - a);
    if (x < a)
        return x * x / k;
    else if (x < 1.0 - a)
        return (x - 0.5 * a) / (1.0 - a);
    else
        return 1.0 - x * x / k;
}

float threshold(float3 position, float3 dpdx, float3 dpdy)
{
    float footprint = max(length(dpdx), length(dpdy));
    float l = log2(rcp(footprint));

    float lower = CellRandom(floor(position * exp2(floor(l))));
    float upper = CellRandom(floor(position * exp2(ceil(l))));

    float w = frac(l);
    return clamp(Cdf(lerp(lower, upper, w), w), 1.0e-6, 1.0);
}
