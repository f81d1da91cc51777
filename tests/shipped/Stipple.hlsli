/* Stipple.hlsli -- "who survives", for every pass that has a depth buffer
 *
 * Conventions: LS = local space, WS = world space, SS = screen space. Every function returns true for fragments that
 * are to be kept.
 */
#ifndef STIPPLE_HLSLI
#define STIPPLE_HLSLI

static const float STIPPLE_SIZE = 1.0f;

static const float BAYER[16] =
{
     0.0f / 16.0f,  8.0f / 16.0f,  2.0f / 16.0f, 10.0f / 16.0f,
    12.0f / 16.0f,  4.0f / 16.0f, 14.0f / 16.0f,  6.0f / 16.0f,
     3.0f / 16.0f, 11.0f / 16.0f,  1.0f / 16.0f,  9.0f / 16.0f,
    15.0f / 16.0f,  7.0f / 16.0f, 13.0f / 16.0f,  5.0f / 16.0f
};

// The one we had before. Still in use for distance fades.
bool BayerTestPasses(float alpha, float4 positionSS)
{
    uint2 p = uint2(positionSS.xy) & 3;
    return alpha > BAYER[p.y * 4 + p.x];
}

float SineNoise(float2 v)
{
    float a = sin(17.0f * v.x + 0.1f * v.y);
    float b = sin(13.0f * v.y + v.x);
    return frac(1.0e4f * a * (0.1f + abs(b)));
}

float SineNoise(float3 v)
{
    return SineNoise(float2(SineNoise(v.xy), v.z));
}

struct StippleLevel
{
    float coarse;
    float fine;
    float blend;
};

StippleLevel GetStippleLevel(float3 positionLS)
{
    float3 dx = ddx(positionLS);
    float3 dy = ddy(positionLS);
    float  deriv = min(length(dx), length(dy));

    float l = log2(1.0f / (STIPPLE_SIZE * deriv));

    StippleLevel level;
    level.coarse = exp2(floor(l));
    level.fine   = exp2(ceil(l));
    level.blend  = frac(l);
    return level;
}

float EqualizeStipple(float x, float blend)
{
    float a = min(blend, 1.0f - blend);
    float b = 1.0f - a;
    float k = 0.5f / (a * b);

    return (x < a) ? x * x * k
         : (x < b) ? (x - 0.5f * a) / b
                   : 1.0f - (1.0f - x) * (1.0f - x) * k;
}

bool HashTestPasses(float alpha, float3 positionLS)
{
    StippleLevel level = GetStippleLevel(positionLS);

    float n0 = SineNoise(floor(positionLS * level.coarse));
    float n1 = SineNoise(floor(positionLS * level.fine));
    float x  = lerp(n0, n1, level.blend);

    float threshold = clamp(EqualizeStipple(x, level.blend), 1.0e-6f, 1.0f);
    return !(alpha < threshold);
}

#define STIPPLE_OR_DIE(alpha, posLS) \
    do { \
        if (!HashTestPasses((alpha), (posLS))) \
            discard; \
    } while (0)

#endif // STIPPLE_HLSLI
