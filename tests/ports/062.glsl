uvec3 pcg3d(uvec3 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

float latticeNoise(vec3 q)
{
    uvec3 r = pcg3d(uvec3(ivec3(floor(q))));
    return float(r.z >> 8) / 16777216.0;
}

float threshold(vec3 position)
{
    vec3 width = max(abs(dFdx(position)), abs(dFdy(position)));
    vec3 l = log2(0.707 / width);

    vec3 coarse = exp2(floor(l));
    vec3 fine = coarse + coarse;

    vec3 p = fract(l);
    float u = length(p);
    float v = length(vec3(1.0) - p);
    float lerpFactor = u / (u + v);

    float x = mix(latticeNoise(coarse * position), latticeNoise(fine * position), lerpFactor);

    float a = min(lerpFactor, 1.0 - lerpFactor);
    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    float t = (lerpFactor < (1.0 - a))
        ? ((lerpFactor < a) ? cases.x : cases.y)
        : cases.z;
    return clamp(t, 1.0e-6, 1.0);
}
