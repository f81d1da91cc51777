uint PcgHash(uint input)
{
    uint state = input * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

float Rand3(float3 p)
{
    uint3 c = asuint(int3(floor(p)));
    uint h = PcgHash(c.z);
    h = PcgHash(h + c.y);
    h = PcgHash(h + c.x);
    return float(h) / 4294967296.0;
}

// Anisotropic alpha hashing for ground cover seen at grazing angles.
float threshold(float3 position)
{
    float3 stepX = abs(ddx(position));
    float3 stepY = abs(ddy(position));
    float3 span = max(max(stepX, stepY), 1.0e-8);

    float3 scales = 0.707 / span.yxz;
    float3 lg = log2(scales);

    float3 low = exp2(floor(lg));
    float3 high = low * 2.0;

    float3 loc = lg - floor(lg);
    float toLow = length(loc);
    float toHigh = length(float3(1.0, 1.0, 1.0) - loc);
    float w = toLow / (toLow + toHigh);

    float x = lerp(Rand3(low * position), Rand3(high * position), w);

    float a = min(w, 1.0 - w);
    float denom = 2.0 * a * (1.0 - a);
    float t;
    if (x < a)
        t = x * x / denom;
    else if (x >= 1.0 - a)
        t = 1.0 - (1.0 - x) * (1.0 - x) / denom;
    else
        t = (x - 0.5 * a) / (1.0 - a);
    return clamp(t, 1.0e-6, 1.0);
}
