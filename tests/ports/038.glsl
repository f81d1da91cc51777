#define PCG_MUL 1664525u
#define PCG_ADD 1013904223u

uvec4 pcg4d(uvec4 v)
{
    v = v * PCG_MUL + PCG_ADD;
    v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
    v = v ^ (v >> 16u);
    v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
    return v;
}

float cellRandom(vec3 p, float scale)
{
    ivec3 cell = ivec3(floor(p * scale));
    uvec4 key = uvec4(uvec3(cell), floatBitsToUint(scale));
    return float(pcg4d(key).w >> 8) / 16777216.0;
}

float distribution(float x, float a)
{
    float d = 2.0 * a * (1.0 - a);
    if (x < a)
        return x * x / d;
    if (x > 1.0 - a)
        return 1.0 - (1.0 - x) * (1.0 - x) / d;
    return (x - 0.5 * a) / (1.0 - a);
}

float threshold(vec3 position, vec3 dpdx, vec3 dpdy)
{
    float maxDeriv = max(length(dpdx), length(dpdy));
    float level = log2(1.0 / maxDeriv);

    float scaleLow = exp2(floor(level));
    float scaleHigh = scaleLow;
    float w = fract(level);

    float x = (1.0 - w) * cellRandom(position, scaleLow) + w * cellRandom(position, scaleHigh);
    return clamp(distribution(x, min(w, 1.0 - w)), 1.0e-6, 1.0);
}
