uint PcgNext(uint seed)
{
    uint state = seed * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

uint PcgCell(int4 key)
{
    uint h = 0u;
    [unroll]
    for (int i = 0; i < 4; ++i)
        h = PcgNext(h ^ asuint(key[i]));
    return h;
}

float OctaveValue(float3 p, float octave)
{
    int3 cell = int3(floor(p * exp2(octave)));
    uint bits = PcgCell(int4(cell, int(octave)));
    return float(bits >> 8) / 16777216.0;
}

float threshold(float3 worldPos)
{
    float size = max(length(ddx(worldPos)), length(ddy(worldPos)));
    float level = log2(1.0 / max(size, 1e-8));
    float base = floor(level);
    float w = level - base;

    float coarse = OctaveValue(worldPos, base);
    float fine = OctaveValue(worldPos, base + 1.0);
    float x = lerp(fine, coarse, w);

    float a = min(w, 1.0 - w);
    if (x < a)
        return clamp(x * x / (2.0 * a * (1.0 - a)), 1.0e-6, 1.0);
    if (x < 1.0 - a)
        return clamp((x - 0.5 * a) / (1.0 - a), 1.0e-6, 1.0);
    float y = 1.0 - x;
    return clamp(1.0 - y * y / (2.0 * a * (1.0 - a)), 1.0e-6, 1.0);
}
