const float grain = 1.0;

float rnd(vec2 v)
{
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float rnd3(vec3 v)
{
    return rnd(vec2(rnd(v.xy), v.z));
}

float threshold(vec3 objPos)
{
    float sx = 1.0 / (grain * length(dFdx(objPos)));
    float sy = 1.0 / (grain * length(dFdy(objPos)));
    float lg = log2(max(sx, sy));

    float base = floor(lg);
    float f = lg - base;
    float r0 = rnd3(floor(objPos * exp2(base)));
    float r1 = rnd3(floor(objPos * exp2(base + 1.0)));
    float x = mix(r0, r1, f);

    float a = min(f, 1.0 - f);
    float t;
    if (x < a)
        t = x * x / (2.0 * a * (1.0 - a));
    else if (x < 1.0 - a)
        t = (x - 0.5 * a) / (1.0 - a);
    else
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));

    return clamp(t, 1.0e-6, 1.0);
}
