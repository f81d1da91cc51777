uint hashU(uvec3 x)
{
    const uint k = 1103515245u;
    for (int i = 0; i < 3; ++i)
        x = ((x >> 8u) ^ x.yzx) * k;
    return x.x;
}

float cellNoise(vec3 p, vec3 scale)
{
    ivec3 cell = ivec3(floor(p * scale));
    uvec3 key = uvec3(cell >> 1);
    uvec3 octave = floatBitsToUint(scale);
    uint h = hashU(key + uvec3(hashU(octave)));
    return float(h >> 8u) / 16777216.0;
}

float lerpWeight(vec3 loc)
{
    vec2 d = vec2(length(loc), length(vec3(1.0) - loc));
    return d.x / (d.x + d.y);
}

float threshold(vec3 position, vec3 dpdx, vec3 dpdy)
{
    vec3 d = max(max(abs(dpdx), abs(dpdy)), vec3(1e-8));
    vec3 lg = log2(0.707 / d);
    vec3 flr = floor(lg);

    float w = lerpWeight(lg - flr);
    float x = mix(cellNoise(position, exp2(flr)),
                  cellNoise(position, exp2(flr + 1.0)), w);

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
