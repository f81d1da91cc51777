// Alpha hashing, permuted congruential generator in place of the sines.
#define HASH_SCALE 1.0f

uint Pcg(uint v)
{
    uint state = v * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

float Noise(float3 cell)
{
    int3 i = int3(cell);
    uint h = Pcg(uint(i.x) + Pcg(uint(i.y) + Pcg(uint(i.z))));
    return float(h & 0xFFu) / 256.0f;
}

float threshold(float3 position)
{
    float maxDeriv = max(length(ddx(position)), length(ddy(position)));
    float pixScale = 1.0f / (HASH_SCALE * maxDeriv);

    float lgFloor = floor(log2(pixScale));
    float lgCeil = ceil(log2(pixScale));

    float alpha0 = Noise(floor(exp2(lgFloor) * position));
    float alpha1 = Noise(floor(exp2(lgCeil) * position));

    float f = frac(log2(pixScale));
    float x = (1.0f - f) * alpha0 + f * alpha1;

    float a = min(f, 1.0f - f);

    [flatten]
    if (x < a)
        x = x * x / (2.0f * a * (1.0f - a));
    else if (x < 1.0f - a)
        x = (x - 0.5f * a) / (1.0f - a);
    else
        x = 1.0f - (1.0f - x) * (1.0f - x) / (2.0f * a * (1.0f - a));

    return clamp(x, 1.0e-6f, 1.0f);
}
