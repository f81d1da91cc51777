uint Wang(uint s)
{
    s = (s ^ 61u) ^ (s >> 16);
    s *= 9u;
    s = s ^ (s >> 4);
    s *= 0x27d4eb2du;
    s = s ^ (s >> 15);
    return s;
}

float CellHash(float3 p, int octave)
{
    int3 c = int3(floor(p * exp2(float(octave))));
    uint key = uint(c.x + c.y + c.z);
    return float(Wang(key ^ Wang(uint(octave))) >> 8) / 16777216.0;
}

float Uniform(float x, float a)
{
    float b = 1.0 - a;
    if (x < a)
        return 0.5 * x * x / (a * b);
    if (x < b)
        return (x - 0.5 * a) / b;
    return 1.0 - 0.5 * (1.0 - x) * (1.0 - x) / (a * b);
}

float HashedThreshold(float3 position, float3 dpdx, float3 dpdy)
{
    float maxDeriv = max(length(dpdx), length(dpdy));
    float l = -log2(max(maxDeriv, 1.0e-8));

    int o = int(floor(l));
    float f = l - floor(l);

    float x = lerp(CellHash(position, o), CellHash(position, o + 1), f);
    return clamp(Uniform(x, min(f, 1.0 - f)), 1.0e-6, 1.0);
}
