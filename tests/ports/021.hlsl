// Smooth cut-outs: a stable threshold out of the object-space position.
static const float kHashScale = 1.0;

float SineHash(float2 s)
{
    return frac(1.0e4 * sin(17.0 * s.x + 0.1 * s.y) * (0.1 + abs(sin(13.0 * s.y + s.x))));
}

float SineHash3(float3 s)
{
    return SineHash(float2(SineHash(s.xy), s.z));
}

float LatticeHash(float3 p)
{
    float3 c = floor(p);
    float3 f = p - c;
    float2 e = float2(0.0, 1.0);
    float4 front = float4(SineHash3(c + e.xxx), SineHash3(c + e.yxx),
                          SineHash3(c + e.xyx), SineHash3(c + e.yyx));
    float4 back = float4(SineHash3(c + e.xxy), SineHash3(c + e.yxy),
                         SineHash3(c + e.xyy), SineHash3(c + e.yyy));
    float4 xy = lerp(front, back, f.z);
    float2 x = lerp(xy.xy, xy.zw, f.y);
    return lerp(x.x, x.y, f.x);
}

float threshold(float3 position)
{
    float maxDeriv = max(length(ddx(position)), length(ddy(position)));
    float pixScale = 1.0 / (kHashScale * maxDeriv);
    float lg = log2(pixScale);

    float n0 = LatticeHash(position * exp2(floor(lg)));
    float n1 = LatticeHash(position * exp2(ceil(lg)));

    float w = frac(lg);
    float x = lerp(n0, n1, w);

    float a = min(w, 1.0 - w);
    float t;
    if (x < a)
        t = x * x / (2.0 * a * (1.0 - a));
    else if (x < 1.0 - a)
        t = (x - 0.5 * a) / (1.0 - a);
    else
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    return clamp(t, 1.0e-6, 1.0);
}
