uvec4 pcg4d(uvec4 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

float gridNoise(vec3 p)
{
    ivec3 c = ivec3(floor(p));
    uvec4 h = pcg4d(uvec4(uvec3(c), 77u));
    return float(h.x >> 8u) / 16777216.0;
}

float threshold(vec3 position, vec3 dpdx, vec3 dpdy)
{
    vec3 deriv = max(abs(dpdx), abs(dpdy));
    vec3 scales = vec3(0.707) / max(deriv, vec3(1e-8));
    vec3 l = log2(scales);
    vec3 whole = floor(l);
    vec3 part = l - whole;

    float u = length(part);
    float v = length(vec3(1.0) - part);
    float w = u / (u + v);

    float x = (1.0 - w) * gridNoise(exp2(whole) * position)
            + w * gridNoise(exp2(whole + 1.0) * position);

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
