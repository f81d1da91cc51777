uvec3 pcg3d(uvec3 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

float random(vec3 cell)
{
    uint bits = pcg3d(uvec3(ivec3(cell))).x;
    bits &= 0x7fffffffu;
    return float(bits) / 4294967296.0;
}

float threshold(vec3 position)
{
    float maxDeriv = max(length(dFdx(position)), length(dFdy(position)));
    float lod = log2(1.0 / maxDeriv);

    vec2 s = exp2(vec2(floor(lod), ceil(lod)));
    vec2 n = vec2(random(floor(s.x * position)), random(floor(s.y * position)));
    float f = fract(lod);
    float x = mix(n.x, n.y, f);

    float a = min(f, 1.0 - f);
    float q = 1.0 / (1.0 - a);

    float t;
    if (x < a)
        t = 0.5 * x * x / a * q;
    else if (x < 1.0 - a)
        t = (x - 0.5 * a) * q;
    else
        t = 1.0 - 0.5 * (1.0 - x) * (1.0 - x) / a * q;
    return clamp(t, 1.0e-6, 1.0);
}
