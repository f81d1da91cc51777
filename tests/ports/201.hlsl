// Cutout test shared by the hair and foliage materials.
static const float kNoiseSize = 1.0;

float SineHash(float2 k)
{
    float wave = 1.0e4 * sin(17.0 * k.x + 0.1 * k.y);
    return frac(wave * (0.1 + abs(sin(13.0 * k.y + k.x))));
}

float CellNoise(float3 cell)
{
    float xy = SineHash(cell.xy);
    float yz = SineHash(cell.yz);
    float zx = SineHash(cell.zx);
    return (xy + yz + zx) / 3.0;
}

float threshold(float3 worldPos)
{
    float3 ax = abs(ddx(worldPos));
    float3 ay = abs(ddy(worldPos));
    float3 scales = 0.707 / (kNoiseSize * max(ax, ay));

    float3 octave = log2(scales);
    float3 sizeA = exp2(floor(octave));
    float3 sizeB = exp2(ceil(octave));

    float nA = CellNoise(floor(sizeA * worldPos));
    float nB = CellNoise(floor(sizeB * worldPos));

    float3 part = frac(scales);
    float da = length(part);
    float db = length(float3(1.0, 1.0, 1.0) - part);
    float w = da / (da + db);

    float x = lerp(nA, nB, w);
    float a = min(w, 1.0 - w);
    float b = 1.0 - a;

    float t;
    if (x < a)
        t = x * x / (2.0 * a * b);
    else if (x < b)
        t = (x - 0.5 * a) / b;
    else
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * b);

    return clamp(t, 1.0e-6, 1.0);
}
