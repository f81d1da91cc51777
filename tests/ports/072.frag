const float HASH_SCALE = 1.0;

float hash(vec2 v)
{
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float hash3D(vec3 v)
{
    return hash(vec2(hash(v.xy), v.z));
}

// pixel: window coordinates of the fragment
float threshold(vec3 position, vec2 pixel)
{
    float maxDeriv = max(length(dFdx(position)), length(dFdy(position)));
    float pixScale = 1.0 / (HASH_SCALE * maxDeriv);

    float lg = log2(pixScale);
    float lo = floor(lg);
    float hi = lo + 1.0;

    vec2 alpha = vec2(hash3D(vec3(floor(pixel), lo)),
                      hash3D(vec3(floor(pixel), hi)));

    float f = fract(lg);
    float x = (1.0 - f) * alpha.x + f * alpha.y;

    const float a = 0.5;
    const float k = 1.0 / (2.0 * a * (1.0 - a));

    float t;
    if (x < a)
        t = k * x * x;
    else if (x < 1.0 - a)
        t = (x - 0.5 * a) / (1.0 - a);
    else
        t = 1.0 - k * (1.0 - x) * (1.0 - x);

    return clamp(t, 1.0e-6, 1.0);
}
