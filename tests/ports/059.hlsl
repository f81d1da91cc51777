static const uint P2 = 2246822519u;
static const uint P3 = 3266489917u;
static const uint P4 = 668265263u;
static const uint P5 = 374761393u;

uint Rotate17(uint h)
{
    return (h << 17) | (h >> 15);
}

uint XxHash32(uint4 p)
{
    uint h = p.w + P5 + p.x * P3;
    h = P4 * Rotate17(h);
    h += p.y * P3;
    h = P4 * Rotate17(h);
    h += p.z * P3;
    h = P4 * Rotate17(h);
    h = P2 * (h ^ (h >> 15));
    h = P3 * (h ^ (h >> 13));
    return h ^ (h >> 16);
}

float Value(float3 pos, float scale)
{
    int3 cell = (int3)floor(pos * scale);
    uint h = XxHash32(uint4(asuint(cell), asuint(scale)));
    return (h >> 8) / 16777216.0;
}

float threshold(float3 pos)
{
    float3 dx = ddx(pos);
    float3 dy = ddy(pos);
    float deriv = max(dot(dx, dx), dot(dy, dy));

    float level = log2(1.0 / deriv);
    float2 scales = exp2(float2(floor(level), ceil(level)));
    float w = frac(level);
    float x = lerp(Value(pos, scales.x), Value(pos, scales.y), w);

    float a = min(w, 1.0 - w);
    float k = rcp(2.0 * a * (1.0 - a));
    float t = x < a ? x * x * k
            : x < 1.0 - a ? (x - 0.5 * a) / (1.0 - a)
            : 1.0 - (1.0 - x) * (1.0 - x) * k;
    return clamp(t, 1.0e-6, 1.0);
}
