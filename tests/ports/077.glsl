#define HASH_SCALE 1.0

float hash(vec2 v)
{
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y)
                       * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float hash3D(vec3 v)
{
    return hash(vec2(hash(v.xy), v.z));
}

float cumulative(float x, float a)
{
    float b = 1.0 - a;
    vec3 cases = vec3(x * x / (2.0 * a * b),
                      (x - 0.5 * a) / b,
                      1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * b));
    return (x < b) ? ((x < a) ? cases.x : cases.y) : cases.z;
}

float threshold(vec3 pos)
{
    float maxDeriv = max(length(dFdx(pos)), length(dFdy(pos)));
    float pixScale = 1.0 / (HASH_SCALE * maxDeriv);
    float level = log2(pixScale);

    float low = exp2(floor(level));
    float high = exp2(floor(level) + 1.0);

    float h0 = hash3D(floor(low * pos));
    float h1 = hash3D(floor(high * pos));

    float a = fract(level);
    float x = mix(h0, h1, a);

    return clamp(cumulative(x, a), 1.0e-6, 1.0);
}
