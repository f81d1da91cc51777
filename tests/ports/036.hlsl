// hashScale: wanted width of a noise cell, in pixels.
float hash(float2 v)
{
    return frac(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) *
                (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float hash3D(float3 v)
{
    return hash(float2(hash(v.xy), v.z));
}

float threshold(float3 position, float3 dpdx, float3 dpdy, float hashScale)
{
    float3 anisoDeriv = max(abs(dpdx), abs(dpdy));
    anisoDeriv = max(anisoDeriv, 1e-8);
    float3 anisoScales = float3(0.707 / anisoDeriv.x,
                                0.707 / anisoDeriv.y,
                                0.707 / anisoDeriv.z);

    float3 lg = log2(anisoScales);
    float3 scaleFlr = exp2(floor(lg));
    float3 scaleCeil = exp2(ceil(lg));

    float2 alpha = float2(hash3D(floor(scaleFlr * position)),
                          hash3D(floor(scaleCeil * position)));

    float3 fractLoc = frac(lg);
    float2 toCorners = float2(length(fractLoc), length(1.0 - fractLoc));
    float lerpFactor = toCorners.x / (toCorners.x + toCorners.y);

    float x = (1.0 - lerpFactor) * alpha.x + lerpFactor * alpha.y;
    float a = min(lerpFactor, 1.0 - lerpFactor);

    float3 cases = float3(x * x / (2.0 * a * (1.0 - a)),
                          (x - 0.5 * a) / (1.0 - a),
                          1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    float t = (x < 1.0 - a) ? (x < a ? cases.x : cases.y) : cases.z;
    return clamp(t, 1.0e-6, 1.0);
}
