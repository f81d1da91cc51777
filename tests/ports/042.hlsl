// Shared by the shadow and GBuffer passes.
float Hash12(float2 p)
{
    return frac(1e4 * sin(17.0 * p.x + p.y * 0.1) * (0.1 + abs(sin(p.y * 13.0 + p.x))));
}

float Hash13(float3 p)
{
    return Hash12(float2(Hash12(p.xy), p.z));
}

float Uniformize(float x, float a)
{
    float b = 1.0 - a;

    if (x < a)
        return (x * x) / (2.0 * a * b);

    if (x < b)
        return (x - 0.5 * a) / b;

    float y = 1.0 - x;
    return 1.0 - (y * y) / (2.0 * a * b);
}

float HashedAlpha(float3 worldPos)
{
    float deriv = max(length(ddx(worldPos)), length(ddy(worldPos)));
    float logScale = log2(1.0 / deriv);

    float2 scales = float2(exp2(floor(logScale)), exp2(ceil(logScale)));
    float h0 = Hash13(floor(worldPos * scales.x));
    float h1 = Hash13(floor(worldPos * scales.y));

    float f = frac(logScale);
    float t = Uniformize(lerp(h0, h1, f), min(f, 1.0 - f));
    t = floor(t * 255.0) / 255.0;
    return clamp(t, 0.0, 1.0);
}
