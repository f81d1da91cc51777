precision highp float;
precision highp int;

uint iqHash(uint n)
{
    n = (n << 13) ^ n;
    n = n * (n * n * 15731u + 789221u) + 1376312589u;
    return n ^ (n >> 15);
}

float draw(uint key, int octave)
{
    uint h = iqHash(key ^ iqHash(uint(octave) + 77u));
    return float(iqHash(h) >> 8) / 16777216.0;
}

// instanceSeed: a value in [0, 1) stored beside each instance's transform
float threshold(vec3 pos, float instanceSeed)
{
    float widest = max(length(dFdx(pos)), length(dFdy(pos)));
    float level = log2(1.0 / max(widest, 1.0e-8));
    int octave = int(floor(level));
    float f = level - float(octave);

    uint key = floatBitsToUint(instanceSeed);
    float x = draw(key, octave) * (1.0 - f) + draw(key, octave + 1) * f;

    float a = min(f, 1.0 - f);
    float b = 1.0 - a;
    float t = x < a ? x * x / (2.0 * a * b)
            : x < b ? (x - 0.5 * a) / b
            : 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * b);
    return clamp(t, 1.0e-6, 1.0);
}
