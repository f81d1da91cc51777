precision highp float;
precision highp int;

struct Blend
{
    int octave;
    float weight;
};

uint rotl(uint x, int r)
{
    return (x << r) | (x >> (32 - r));
}

uint xxRound(uint acc, uint word)
{
    return rotl(acc + word * 3266489917u, 17) * 668265263u;
}

uint xxHash(ivec4 k)
{
    uint h = 374761393u + 16u;
    h = xxRound(h, uint(k.x));
    h = xxRound(h, uint(k.y));
    h = xxRound(h, uint(k.z));
    h = xxRound(h, uint(k.w));
    h = (h ^ (h >> 15)) * 2246822519u;
    h = (h ^ (h >> 13)) * 3266489917u;
    return h ^ (h >> 16);
}

float noiseIn(vec3 P, int octave)
{
    vec3 cell = floor(P * exp2(float(octave)));
    return float(xxHash(ivec4(ivec3(cell), octave)) >> 8) / 16777216.0;
}

Blend pick(float scale)
{
    float l = log2(scale);
    Blend b;
    b.octave = int(floor(l));
    b.weight = l - floor(l);
    return b;
}

float alphaThreshold(vec3 P)
{
    vec3 dx = dFdx(P);
    vec3 dy = dFdy(P);
    float d = sqrt(max(dot(dx, dx), dot(dy, dy)));
    Blend b = pick(1.0 / max(d, 1.0e-8));

    float lo = noiseIn(P, b.octave);
    float hi = noiseIn(P, b.octave + 1);
    float x = lo + b.weight * (hi - lo);

    float a = min(b.weight, 1.0 - b.weight);
    float t;
    if (x < a)
        t = x * x / (2.0 * a * (1.0 - a));
    else if (x > 1.0 - a)
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    else
        t = (x - 0.5 * a) / (1.0 - a);

    return clamp(t, 1.0e-6, 1.0);
}
