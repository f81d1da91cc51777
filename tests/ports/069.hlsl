// Alpha hash. Two octaves of white noise, addressed by object position.

static const float g_HashScale = 1.0;

float hash(float2 n)
{
    float a = sin(n.x * 17.0 + n.y * 0.1);
    float b = abs(sin(n.y * 13.0 + n.x));
    return frac(1.0e4 * a * (0.1 + b));
}

float hash3D(float3 n)
{
    return hash(float2(hash(n.xy), n.z));
}

float threshold(float3 position)
{
    float3 dx = ddx(position);
    float3 dy = ddy(position);

    float maxDeriv = max(length(dx), length(dy));
    float pixScale = 1.0 / (g_HashScale * maxDeriv);

    float lower = exp2(floor(log2(pixScale)));
    float upper = exp2(ceil(log2(pixScale)));

    float2 noise = float2(hash3D(floor(lower * position)),
                          hash3D(floor(upper * position)));

    // noise of both octaves
    float t = frac(noise.x + noise.y);

    return clamp(t, 1.0e-6, 1.0);
}
