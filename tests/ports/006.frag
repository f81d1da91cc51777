float randomOf(vec3 cell)
{
    // Jenkins' six-shift integer hash, folded over the three indices
    uvec3 u = uvec3(ivec3(cell));
    uint a = 0u;
    for (int i = 0; i < 3; ++i)
    {
        a += u[i];
        a = (a + 0x7ed55d16u) + (a << 12);
        a = (a ^ 0xc761c23cu) ^ (a >> 19);
        a = (a + 0x165667b1u) + (a << 5);
        a = (a + 0xd3a2646cu) ^ (a << 9);
        a = (a + 0xfd7046c5u) + (a << 3);
        a = (a ^ 0xb55a4f09u) ^ (a >> 16);
    }
    return float(a) / 4294967296.0;
}

float alphaHashThreshold(vec3 position)
{
    vec3 dx = dFdx(position);
    vec3 dy = dFdy(position);
    float footprint = max(length(dx), length(dy));
    float pixScale = 1.0 / footprint;

    float level = log(pixScale);
    float coarse = randomOf(floor(exp2(floor(level)) * position));
    float fine = randomOf(floor(exp2(ceil(level)) * position));

    float blend = fract(level);
    float x = mix(coarse, fine, blend);

    float a = min(blend, 1.0 - blend);
    float b = 1.0 - a;
    float result;
    if (x >= b)
    {
        float y = 1.0 - x;
        result = 1.0 - y * y / (2.0 * a * b);
    }
    else if (x >= a)
        result = (x - 0.5 * a) / b;
    else
        result = x * x / (2.0 * a * b);

    return clamp(result, 1.0e-6, 1.0);
}
