precision highp float;

uint rotl(uint v, uint n) { return (v << n) | (v >> (32u - n)); }

uint mixIn(uint h, uint k)
{
    k *= 0xcc9e2d51u;
    k = rotl(k, 15u);
    k *= 0x1b873593u;
    h ^= k;
    h = rotl(h, 13u);
    return h * 5u + 0xe6546b64u;
}

uint finish(uint h)
{
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    h ^= h >> 16;
    return h;
}

float gridNoise(vec3 p, vec3 s)
{
    uvec3 cell = uvec3(ivec3(floor(p * s)));
    uvec3 oct = floatBitsToUint(s);
    uint h = 0x2f6e2b1u;
    h = mixIn(h, cell.x);
    h = mixIn(h, cell.y);
    h = mixIn(h, cell.z);
    h = mixIn(h, oct.x);
    h = mixIn(h, oct.y);
    h = mixIn(h, oct.z);
    return float(finish(h ^ 24u) >> 8u) / 16777216.0;
}

float HashedAlpha(vec3 P)
{
    vec3 d = max(abs(dFdx(P)), abs(dFdy(P)));
    vec3 s = vec3(0.707) / d;
    vec3 l = log2(s);

    vec3 f = fract(l);
    float c0 = length(f);
    float c1 = length(1.0 - f);
    float w = c0 / (c0 + c1);

    float n0 = gridNoise(P, exp2(floor(l)));
    float n1 = gridNoise(P, exp2(ceil(l)));
    float t = mix(n0, n1, w);

    return clamp(t, 1.0e-6, 1.0);
}
