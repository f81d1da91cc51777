// Integer hash on the lattice (Quilez).
uint latticeHash(uvec3 x)
{
    const uint k = 1103515245U;
    x = ((x >> 8U) ^ x.yzx) * k;
    x = ((x >> 8U) ^ x.yzx) * k;
    x = ((x >> 8U) ^ x.yzx) * k;
    return x.x;
}

float cellValue(vec3 p)
{
    ivec3 c = ivec3(floor(p));
    uvec3 u = uvec3(c) & 0xffffu;
    return float(latticeHash(u)) * (1.0 / float(0xffffffffU));
}

float threshold(vec3 position, vec3 dpdx, vec3 dpdy, float hash_scale)
{
    float maxDeriv = max(length(dpdx), length(dpdy));
    float pixScale = 1.0 / (hash_scale * maxDeriv);

    float lg = log2(pixScale);
    float lo = exp2(floor(lg));
    float hi = exp2(ceil(lg));

    vec2 n = vec2(cellValue(lo * position), cellValue(hi * position));
    float f = fract(lg);
    float x = mix(n.x, n.y, f);

    float a = min(f, 1.0 - f);
    float t;
    if (x < a) {
        t = x * x / (2.0 * a * (1.0 - a));
    } else if (x < 1.0 - a) {
        t = (x - 0.5 * a) / (1.0 - a);
    } else {
        float r = 1.0 - x;
        t = 1.0 - r * r / (2.0 * a * (1.0 - a));
    }
    return clamp(t, 1.0e-6, 1.0);
}
