// Thresholds for thin geometry seen at grazing angles.

uint pcg(uint v)
{
    uint s = v * 747796405u + 2891336453u;
    uint w = ((s >> ((s >> 28) + 4u)) ^ s) * 277803737u;
    return (w >> 22) ^ w;
}

uint chain(ivec3 k, uint seed)
{
    return pcg(uint(k.z) + pcg(uint(k.y) + pcg(uint(k.x) + seed)));
}

float lattice(vec3 p, vec3 octave)
{
    ivec3 cell = ivec3(floor(p * exp2(octave)));
    uint seed = chain(ivec3(octave), 0u);
    return float(chain(cell, seed) >> 8) / 16777216.0;
}

float threshold(vec3 pos, float hash_scale)
{
    vec3 d = max(abs(dFdx(pos)), abs(dFdy(pos)));
    d = max(d * hash_scale, vec3(1.0e-7));

    vec3 l = log2(0.707 / d);
    vec3 base = floor(l);
    vec3 f = l - base;

    float toBase = length(f);
    float toNext = length(1.0 - f);
    float w = toBase / (toBase + toNext);

    float x = (1.0 - w) * lattice(pos, base) + w * lattice(pos, base + 1.0);

    float a = min(w, 1.0 - w);
    float b = 1.0 - a;
    float t = (x - 0.5 * a) / b;
    t = x < a ? x * x / (2.0 * a * b) : t;
    t = x > b ? 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * b) : t;
    return clamp(t, 1.0e-6, 1.0);
}
