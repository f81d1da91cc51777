// Stochastic alpha cutout for the foliage pass, with one noise scale per axis.
static const float NOISE_SCALE = 1.0;

float Hash2(float2 v)
{
    return frac(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float Hash3(float3 v)
{
    return Hash2(float2(Hash2(v.xy), v.z));
}

float threshold(float3 position)
{
    // widest step of each axis across the pixel
    float3 step3 = max(abs(ddx(position)), abs(ddy(position)));
    float3 scales = 0.707 / (NOISE_SCALE * step3);

    float3 level = floor(log2(scales));
    float3 lo = exp2(level);
    float3 hi = exp2(level + 2.0);

    float h0 = Hash3(floor(lo * position));
    float h1 = Hash3(floor(hi * position));

    float3 f = frac(log2(scales));
    float near = length(f);
    float far = length(float3(1.0, 1.0, 1.0) - f);
    float w = near / (near + far);

    float x = lerp(h0, h1, w);

    float a = min(w, 1.0 - w);
    float3 cases = float3(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)));
    float t = (x < 1.0 - a) ? ((x < a) ? cases.x : cases.y) : cases.z;
    t = pow(saturate(t), 1.4);
    return clamp(t, 1.0e-6, 1.0);
}
