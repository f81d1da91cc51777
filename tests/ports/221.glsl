uint scramble(uint k)
{
    k = (k ^ (k >> 16)) * 0x7feb352du;
    k = (k ^ (k >> 15)) * 0x846ca68bu;
    return k ^ (k >> 16);
}

float value(vec3 p)
{
    ivec3 c = ivec3(floor(p));
    uint h = scramble(uint(c.y) + 0x9e3779b9u);
    h = scramble(h ^ uint(c.y));
    h = scramble(h ^ uint(c.z));
    return float(h >> 8) * 5.9604644775390625e-8;
}

float flatten(float x, float a)
{
    float b = 1.0 - a;
    float den = 2.0 * a * b;
    if (x < a)
        return x * x / den;
    else if (x < b)
        return (x - a * 0.5) / b;
    return 1.0 - (1.0 - x) * (1.0 - x) / den;
}

float threshold(vec3 position, vec3 dpdx, vec3 dpdy, float hash_scale)
{
    vec3 widest = max(abs(dpdx), abs(dpdy)) * hash_scale;
    vec3 lg = log2(0.707 / widest);
    vec3 lo = exp2(floor(lg));
    vec3 hi = 2.0 * lo;

    vec3 f = fract(lg);
    float dLo = sqrt(dot(f, f));
    float dHi = sqrt(dot(1.0 - f, 1.0 - f));
    float w = dLo / (dLo + dHi);

    float x = mix(value(position * lo), value(position * hi), w);
    return clamp(flatten(x, min(w, 1.0 - w)), 1.0e-6, 1.0);
}
