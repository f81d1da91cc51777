precision highp float;
const float u_hashScale = 1.0;

float hashXY(float x, float y)
{
    return fract(1.0e4 * sin(17.0 * x + 0.1 * y) * (0.1 + abs(sin(13.0 * y + x))));
}

float hashXYZ(vec3 c)
{
    return hashXY(hashXY(c.x, c.y), c.z);
}

float blendToUniform(float x, float f)
{
    float a = min(f, 1.0 - f);
    float oneMinusA = 1.0 - a;
    float twice = 2.0 * a * oneMinusA;

    if (x >= oneMinusA)
        return 1.0 - (1.0 - x) * (1.0 - x) / twice;
    if (x >= a)
        return (x - 0.5 * a) / oneMinusA;
    return x * x / twice;
}

float threshold(vec3 position)
{
    float gradX = length(dFdx(position));
    float gradY = length(dFdx(position));
    float pixScale = 1.0 / (u_hashScale * max(gradX, gradY));

    float lg = log2(pixScale);
    float lo = floor(lg);
    float hi = ceil(lg);
    float f = fract(lg);

    float nLo = hashXYZ(floor(position * exp2(lo)));
    float nHi = hashXYZ(floor(position * exp2(hi)));

    return clamp(blendToUniform(mix(nLo, nHi, f), f), 1.0e-6, 1.0);
}
