const float kScale = 1.0;

float hash(vec2 v)
{
    float p = 17.0 * v.x + 0.1 * v.y;
    float q = 13.0 * v.y + v.x;
    return fract(1.0e4 * sin(p) * (0.1 + abs(sin(q))));
}

float hash3D(vec3 v)
{
    return hash(vec2(hash(v.xy), v.z));
}

float noiseScale(vec3 p)
{
    vec3 g = dFdx(p) + dFdy(p);
    return 1.0 / (kScale * max(length(g), 1e-8));
}

float threshold(vec3 worldPos)
{
    float s = noiseScale(worldPos);
    float l = log2(s);

    float s0 = exp2(floor(l));
    float s1 = exp2(ceil(l));
    float h0 = hash3D(floor(s0 * worldPos));
    float h1 = hash3D(floor(s1 * worldPos));

    float w = fract(l);
    float x = mix(h0, h1, w);
    float a = min(w, 1.0 - w);

    bool isLow = x < a;
    bool isHigh = x >= 1.0 - a;
    float t = (x - 0.5 * a) / (1.0 - a);
    if (isLow)
        t = x * x / (2.0 * a * (1.0 - a));
    else if (isHigh)
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    return clamp(t, 1.0e-6, 1.0);
}
