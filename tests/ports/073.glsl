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

float h3(vec3 c)
{
    return float(pcg3d(uvec3(ivec3(c))).x) * (1.0 / 4294967296.0);
}

float unbias(float x, float w)
{
    float a = min(w, 1.0 - w);
    float den = 2.0 * a * (1.0 - a);

    if (x < a)
        return (x - 0.5 * a) / (1.0 - a);
    else if (x < 1.0 - a)
        return x * x / den;
    else
        return 1.0 - (1.0 - x) * (1.0 - x) / den;
}

float threshold(vec3 pos, float hash_scale)
{
    float d = hash_scale * max(length(dFdx(pos)), length(dFdy(pos)));
    float lg = log(1.0 / d);
    float whole = floor(lg);

    float s0 = exp2(whole);
    float s1 = exp2(whole + 1.0);
    float w = lg - whole;

    float x = mix(h3(floor(s0 * pos)), h3(floor(s1 * pos)), w);
    return clamp(unbias(x, w), 1.0e-6, 1.0);
}
