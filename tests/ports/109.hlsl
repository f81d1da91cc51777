static const float HASH_SCALE = 1.0;

float hash2(float2 v)
{
    return frac(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float hash3(float3 v)
{
    return hash2(float2(hash2(v.xy), v.z));
}

float threshold(float3 worldPos)
{
    float3 d = max(abs(ddx(worldPos)), abs(ddy(worldPos)));
    float3 scales = 0.707 / (HASH_SCALE * d);
    float3 lg = log2(scales);

    float3 lower = exp2(floor(lg));
    float3 upper = exp2(ceil(lg));
    float n0 = hash3(floor(lower * worldPos));
    float n1 = hash3(floor(upper * worldPos));

    float3 loc = frac(lg);
    float toLow = length(loc);
    float toHigh = length(float3(1.0, 1.0, 1.0) - loc);
    float w = toLow / (toLow + toHigh);

    float x = (1.0 - w) * n0 + w * n1;
    float a = min(w, 1.0 - w);
    float3 cases = float3(x * x / (2.0 * a * (1.0 - a)),
                          (x - 0.5 * a) / (1.0 - a),
                          1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)));
    float t = (x < 1.0 - a) ? ((x < a) ? cases.x : cases.y) : cases.z;
    return clamp(t, 1.0e-6, 1.0);
}
