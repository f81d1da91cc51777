uint3 Pcg3d(uint3 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

float CellValue(float3 p)
{
    int3 cell = int3(floor(p));
    // bits into the mantissa of a float in [1, 2)
    return asfloat((Pcg3d(asuint(cell)).x >> 9) | 0x3f800000u) - 1.0;
}

float threshold(float3 position, float3 dpdx, float3 dpdy)
{
    float lenX = sqrt(dot(dpdx, dpdx));
    float lenY = sqrt(dot(dpdy, dpdy));
    float l = -log2(max(lenX, lenY));

    float low = floor(l);
    float2 s = exp2(float2(low, low + 1.0));
    float2 n = float2(CellValue(s.x * position), CellValue(s.y * position));

    float w = l - low;
    float x = lerp(n.x, n.y, w);
    float a = min(w, 1.0 - w);

    float t;
    if (x < a)
        t = x * x / (2.0 * a * (1.0 - a));
    else if (x < 1.0 - a)
        t = (x - 0.5 * a) / (1.0 - a);
    else
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    return clamp(t, 1.0e-6, 1.0);
}
