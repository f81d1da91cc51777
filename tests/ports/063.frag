// Object-space hashed alpha, integer arithmetic only where it matters.
const uint MUL = 1664525u;
const uint INC = 1013904223u;

uint pcg3(uvec3 v)
{
    v = v * MUL + INC;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    v = v ^ (v >> uvec3(16u));
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    return v.x;
}

float cellNoise(vec3 p, float scale)
{
    vec3 q = abs(p) * scale;
    uint h = pcg3(uvec3(ivec3(floor(q))));
    return float(h >> 8) * (1.0 / 16777216.0);
}

float threshold(vec3 objPos, float hash_scale)
{
    float maxDeriv = max(length(dFdx(objPos)), length(dFdy(objPos)));
    float pixScale = 1.0 / (hash_scale * maxDeriv);
    float lg = log2(pixScale);

    float first = cellNoise(objPos, exp2(floor(lg)));
    float second = cellNoise(objPos, exp2(floor(lg)));
    float f = fract(lg);
    float x = (1.0 - f) * first + f * second;

    float a = min(f, 1.0 - f);
    float t;
    if (x < a)
        t = (x * x) / (2.0 * a * (1.0 - a));
    else if (x < 1.0 - a)
        t = (x - 0.5 * a) / (1.0 - a);
    else
        t = 1.0 - ((1.0 - x) * (1.0 - x)) / (2.0 * a * (1.0 - a));
    return clamp(t, 1.0e-6, 1.0);
}
