uint wang(uint s)
{
    s = (s ^ 61u) ^ (s >> 16);
    s *= 9u;
    s ^= s >> 4;
    s *= 0x27d4eb2du;
    s ^= s >> 15;
    return s;
}

float toFloat(uint h)
{
    return float(h >> 8) / 16777216.0;
}

float cellNoise(vec3 p)
{
    uvec3 c = uvec3(ivec3(floor(p)));
    float r = toFloat(wang(c.x ^ wang(c.y ^ wang(c.z))));
    float g = toFloat(wang(c.y ^ wang(c.z ^ wang(c.x + 1u))));
    float b = toFloat(wang(c.z ^ wang(c.x ^ wang(c.y + 2u))));
    return (r + g + b) / 3.0;
}

float threshold(vec3 position, vec3 dpdx, vec3 dpdy)
{
    float d = max(length(dpdx), length(dpdy));
    float level = log2(1.0 / max(d, 1e-8));

    float scale = exp2(floor(level));
    float n0 = cellNoise(scale * position);
    float n1 = cellNoise(2.0 * scale * position);

    float f = fract(level);
    float x = mix(n0, n1, f);

    float a = min(f, 1.0 - f);
    float t;
    if (x < a)
        t = x * x / (2.0 * a * (1.0 - a));
    else if (x < 1.0 - a)
        t = (x - 0.5 * a) / (1.0 - a);
    else
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    return clamp(t, 1.0e-6, 1.0);
}
