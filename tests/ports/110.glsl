precision highp float;

#define SIN_HASH(a, b) fract(1.0e4 * sin(17.0 * (a) + 0.1 * (b)) * (0.1 + abs(sin(13.0 * (b) + (a)))))

float cellHash(vec3 p)
{
    vec3 c = floor(p);
    float h = SIN_HASH(c.x, c.y);
    return SIN_HASH(h, c.z);
}

// Lesser weight a; x in [0, 1].
float distribution(float x, float a)
{
    float b = 1.0 - a;
    if (x > b)
    {
        float y = 1.0 - x;
        return 1.0 - y * y / (2.0 * a * b);
    }
    if (x < a)
        return x * x / (2.0 * a * b);
    return (x - 0.5 * a) / b;
}

float threshold(vec3 P, float hash_scale)
{
    float size = max(length(dFdx(P)), length(dFdy(P)));
    size = max(hash_scale * size, 1e-8);

    float lod = log2(1.0 / size);
    float s = exp2(floor(lod));
    float w = fract(lod);

    float x = mix(cellHash(s * P), cellHash(2.0 * s * P), w);
    return clamp(distribution(x, min(w, 1.0 - w)), 1.0e-6, 1.0);
}
