const float noiseScale = 1.0;

float hash2(vec2 q)
{
    return fract(1.0e4 * sin(17.0 * q.x + 0.1 * q.y) * (0.1 + abs(sin(13.0 * q.y + q.x))));
}

float hash3(vec3 q)
{
    return hash2(vec2(hash2(q.xy), q.z));
}

float threshold(vec3 objPos)
{
    vec3 d = max(abs(dFdx(objPos)), abs(dFdy(objPos)));
    vec3 lg = log2(0.707 / (noiseScale * d));

    // the two grids, one twice as fine as the other
    vec3 grid = exp2(round(lg));
    float v0 = hash3(floor(objPos * grid));
    float v1 = hash3(floor(objPos * grid * 2.0));

    vec3 f = lg - floor(lg);
    float u = length(f);
    float v = length(1.0 - f);
    float w = u / (u + v);

    float x = v0 * (1.0 - w) + v1 * w;
    float a = min(w, 1.0 - w);
    float k = 0.5 / (a * (1.0 - a));

    float t = x < a ? k * x * x
            : x < 1.0 - a ? (x - 0.5 * a) / (1.0 - a)
            : 1.0 - k * (1.0 - x) * (1.0 - x);

    return clamp(t, 1.0e-6, 1.0);
}
