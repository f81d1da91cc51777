#define HASH_SCALE 1.0

float hash(vec2 k)
{
    return fract(10.0 * sin(17.0 * k.x + 0.1 * k.y) * (0.1 + abs(sin(13.0 * k.y + k.x))));
}

// distribution function of the blended noise
float toUniform(float x, float w)
{
    float a = min(w, 1.0 - w);
    if (x < a)
    {
        return x * x / (2.0 * a * (1.0 - a));
    }
    else if (x < 1.0 - a)
    {
        return (x - a / 2.0) / (1.0 - a);
    }
    float y = 1.0 - x;
    return 1.0 - y * y / (2.0 * a * (1.0 - a));
}

float noiseAt(vec3 p, float scale)
{
    vec3 c = floor(scale * p);
    float k = c.x + c.y + c.z;
    return hash(vec2(hash(vec2(k, 0.0)), k));
}

float threshold(vec3 position)
{
    float ddxLen = length(dFdx(position));
    float ddyLen = length(dFdy(position));
    float pixScale = 1.0 / (HASH_SCALE * max(ddxLen, ddyLen));

    float lg = log2(pixScale);
    float lower = noiseAt(position, exp2(floor(lg)));
    float upper = noiseAt(position, exp2(ceil(lg)));

    float w = fract(lg);
    float x = lower + (upper - lower) * w;
    return clamp(toUniform(x, w), 1.0e-6, 1.0);
}
