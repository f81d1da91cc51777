// HASH_SCALE 1: cells of about one pixel.
#define HASH_SCALE 1.0

float Hash(float2 v)
{
    return frac(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float Hash3D(float3 v)
{
    return Hash(float2(Hash(v.xy), v.z));
}

float Cdf(float x, float a)
{
    float3 cases = float3(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    return (x < 1.0 - a) ? ((x < a) ? cases.x : cases.y) : cases.z;
}

float threshold(float3 objPos)
{
    float maxDeriv = max(length(ddx(objPos)), length(ddy(objPos)));
    float pixScale = 1.0 / (HASH_SCALE * maxDeriv);

    float lg = log2(pixScale);
    float fine = Hash3D(floor(exp2(ceil(lg)) * objPos));
    float coarse = Hash3D(floor(exp2(floor(lg)) * objPos));

    float f = frac(lg);
    float x = f * fine + (1.0 - f) * coarse;
    return clamp(Cdf(x, min(f, 1.0 - f)), 1.0e-6, 1.0);
}
