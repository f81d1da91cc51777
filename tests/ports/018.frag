float sinHash(float a, float b)
{
    return fract(1.0e4 * sin(17.0 * a + 0.1 * b) * (0.1 + abs(sin(13.0 * b + a))));
}

float volumeHash(vec3 c)
{
    return sinHash(sinHash(c.x, c.y), c.z);
}

// x: mean of two uniform numbers with weights 1-w and w
float equalise(float x, float w)
{
    float a = min(w, 1.0 - w);
    float b = 1.0 - a;
    if (x < a)
        return x * x / (a * b);
    if (x < b)
        return (x - 0.5 * a) / b;
    return 1.0 - (1.0 - x) * (1.0 - x) / (a * b);
}

float threshold(vec3 objPos)
{
    float extent = length(dFdx(objPos)) + length(dFdy(objPos));
    float pixScale = 1.0 / extent;

    // the two powers of two around the ideal scale
    vec2 pow2 = vec2(exp2(floor(log2(pixScale))), exp2(ceil(log2(pixScale))));
    vec2 n = vec2(volumeHash(floor(pow2.x * objPos)),
                  volumeHash(floor(pow2.y * objPos)));

    float w = fract(log2(pixScale));
    float x = dot(n, vec2(1.0 - w, w));
    return clamp(equalise(x, w), 1.0e-6, 1.0);
}
