#define ALPHA_NOISE_SCALE 1.0

float Hash(float2 v)
{
    float s = sin(dot(v, float2(17.0, 0.1)));
    float m = 0.1 + abs(sin(dot(v, float2(1.0, 13.0))));
    return frac(1.0e1 * s * m);
}

float Hash(float3 v)
{
    return Hash(float2(Hash(v.xy), v.z));
}

float threshold(float3 objPos)
{
    float3 deriv = max(abs(ddx(objPos)), abs(ddy(objPos)));
    float3 scales = 0.70710678 / (ALPHA_NOISE_SCALE * deriv);
    float3 logs = log2(scales);

    float3 frc = frac(logs);
    float2 dist = float2(length(frc), length(1.0 - frc));
    float w = dist.x / (dist.x + dist.y);

    float2 n;
    n.x = Hash(floor(exp2(floor(logs)) * objPos));
    n.y = Hash(floor(exp2(ceil(logs)) * objPos));
    float x = dot(n, float2(1.0 - w, w));

    float a = min(w, 1.0 - w);
    float q = 2.0 * a * (1.0 - a);
    float t = (x < a) ? x * x / q
            : (x < 1.0 - a) ? (x - 0.5 * a) / (1.0 - a)
            : 1.0 - (1.0 - x) * (1.0 - x) / q;

    return clamp(t, 1.0e-6, 1.0);
}
