#define HASH_SCALE 1.0f

// Hash functions of the original paper
float hash(float2 value)
{
    return frac(1.0e4f * sin(17.0f * value.x + 0.1f * value.y) * (0.1f + abs(sin(13.0f * value.y + value.x))));
}

float hash3D(float3 value)
{
    return hash(float2(hash(value.xy), value.z));
}

float threshold(float3 objPos)
{
    float maxDeriv = max(length(ddx(objPos)), length(ddy(objPos)));
    float pixScale = 1.0f / (HASH_SCALE * maxDeriv);

    float2 pixScales = float2(exp2(floor(log2(pixScale))), exp2(ceil(log2(pixScale))));
    float2 alpha = float2(hash3D(floor(pixScales.x * objPos)),
                          hash3D(floor(pixScales.y * objPos)));

    float lerpFactor = frac(pixScale);
    float x = lerp(alpha.x, alpha.y, lerpFactor);

    float a = min(lerpFactor, 1.0f - lerpFactor);
    float den = 2.0f * a * (1.0f - a);

    float result;
    if (x < a)
        result = (x * x) / den;
    else if (x < 1.0f - a)
        result = (x - 0.5f * a) / (1.0f - a);
    else
        result = 1.0f - ((1.0f - x) * (1.0f - x)) / den;

    return clamp(result, 1.0e-6f, 1.0f);
}
