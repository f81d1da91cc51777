// Hashed alpha for hair cards; the caller discards where alpha < threshold().
float hash(vec2 p)
{
    float u = 17.0 * p.x + 0.1 * p.y;
    float v = 13.0 * p.y + p.x;
    return fract(1.0e4 * sin(u) * (0.1 + abs(sin(v))));
}

float hash3D(vec3 p)
{
    return hash(vec2(hash(p.xy), p.z));
}

float threshold(vec3 pos, float hash_scale)
{
    float maxDeriv = max(length(dFdx(pos)), length(dFdy(pos)));
    float pixScale = 1.0 / (hash_scale * maxDeriv);

    float lg = log2(pixScale);
    vec2 pixScales = exp2(vec2(floor(lg), ceil(lg)));
    vec2 alpha = vec2(hash3D(floor(pixScales.x * pos)),
                      hash3D(floor(pixScales.y * pos)));

    float lerpFactor = lg - floor(lg);
    float x = mix(alpha.x, alpha.y, lerpFactor);

    float a = min(lerpFactor, 1.0 - lerpFactor);
    float inv = 1.0 / (2.0 * a * (1.0 - a));
    float lowTail = x * x * inv;
    float body = (x - 0.5 * a) / (1.0 - a);
    float highTail = 1.0 - (1.0 - x) * (1.0 - x) * inv;

    float t = x < 1.0 - a ? (x < a ? lowTail : body) : highTail;
    t = 0.5 + 0.5 * (t - 0.5);
    return clamp(t, 1.0e-6, 1.0);
}
