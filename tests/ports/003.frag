// One-at-a-time hash, after Bob Jenkins.
uint oneAtATime(uint x)
{
    x += x << 10u;
    x ^= x >> 6u;
    x += x << 3u;
    x ^= x >> 11u;
    x += x << 15u;
    return x;
}

float hashCell(ivec3 c)
{
    uint h = oneAtATime(uint(c.x));
    h = oneAtATime(h ^ uint(c.y));
    h = oneAtATime(h ^ uint(c.z));
    h = oneAtATime(h);
    return float(h >> 8u) * (1.0 / 16777216.0);
}

float threshold(vec3 position)
{
    float d = max(length(dFdx(position)), length(dFdy(position)));
    d = max(d, 1e-8);
    float level = -log2(d);

    float s0 = exp2(floor(level));
    float s1 = s0 * 2.0;
    vec2 h = vec2(hashCell(ivec3(floor(position * s0))),
                  hashCell(ivec3(floor(position * s1))));

    float k = fract(level);
    float x = mix(h.x, h.y, k);

    float a = min(k, 1.0 - k);
    float t;
    if (x < a)
        t = (x * x) / (2.0 * a * (1.0 - a));
    else if (x < 1.0 - a)
        t = (x - a * 0.5) / (1.0 - a);
    else
        t = 1.0 - ((1.0 - x) * (1.0 - x)) / (2.0 * a * (1.0 - a));

    t = floor(t * 16.0 + 1.0) / 16.0;
    return clamp(t, 1.0e-6, 1.0);
}
