uint4 pcg4d(uint4 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

float Noise(float3 p, float scale)
{
    int3 cell = int3(floor(p * scale));
    uint4 r = pcg4d(uint4(asuint(cell), asuint(scale)));
    return (r.x >> 8) * (1.0 / 16777216.0);
}

// Remaps the interpolated value, given the lesser weight.
float Remap(float x, float a)
{
    float rise = x / (a * (1.0 - a));
    float flat_ = 1.0 / (1.0 - a);
    float fall = (1.0 - x) / (a * (1.0 - a));
    return x < a ? rise : (x < 1.0 - a ? flat_ : fall);
}

float threshold(float3 position)
{
    float3 dx = ddx(position);
    float3 dy = ddx(position);
    float maxDeriv = max(length(dx), length(dy));

    float level = log2(1.0 / maxDeriv);
    float lo = exp2(floor(level));
    float hi = 2.0 * lo;
    float w = frac(level);

    float x = lerp(Noise(position, lo), Noise(position, hi), w);
    return clamp(Remap(x, min(w, 1.0 - w)), 1.0e-6, 1.0);
}
