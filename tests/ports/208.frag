precision highp float;
precision highp int;

uint avalanche(uint h)
{
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    h ^= h >> 16;
    return h;
}

float noiseAt(vec3 p)
{
    ivec3 i = ivec3(floor(p));
    uint xy = (uint(i.x) & 0xffffu) | (uint(i.y) << 16);
    uint z = uint(i.z) & 0xffffu;
    uint h = avalanche(xy + 0x9e3779b9u * avalanche(z + 1u));
    return float(h >> 8) / 16777216.0;
}

float threshold(vec3 p)
{
    vec3 span = abs(dFdx(p)) + abs(dFdy(p));
    float lg = log2(1.0 / length(span));

    float o = floor(lg);
    float w = lg - o;
    float x = mix(noiseAt(p * exp2(o)), noiseAt(p * exp2(o + 1.0)), w);

    float a = min(w, 1.0 - w);
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
