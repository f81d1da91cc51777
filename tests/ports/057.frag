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

float rnd(vec3 p, float octave)
{
    ivec3 cell = ivec3(floor(p * exp2(octave)));
    cell = clamp(cell, ivec3(-128), ivec3(127));
    uvec4 h = pcg4d(uvec4(uvec3(cell), uint(int(octave) + 64)));
    return float(h.x >> 8u) / 16777216.0;
}

float threshold(vec3 P)
{
    float d = length(dFdx(P) + dFdy(P));
    float level = log2(1.0 / max(d, 1.0e-8));
    float o = floor(level);
    float f = level - o;

    float x = (1.0 - f) * rnd(P, o) + f * rnd(P, o + 1.0);

    float a = min(f, 1.0 - f);
    vec3 c = vec3(x * x / (2.0 * a * (1.0 - a)),
                  (x - 0.5 * a) / (1.0 - a),
                  1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)));
    float t = x < a ? c.x : (x < 1.0 - a ? c.y : c.z);
    return clamp(t, 1.0e-6, 1.0);
}
