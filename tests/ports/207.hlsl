float hash(float2 v)
{
    return frac(1.0e4 * sin(17.0 * v.x + 0.1 * v.y)
                * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float hash3D(float3 v)
{
    return hash(float2(hash(v.xy), v.z));
}

// Called from every alpha-tested base pass.
float threshold(float3 pos, float hash_scale)
{
    float lx = length(ddx(pos));
    float ly = length(ddy(pos));
    float pixScale = hash_scale / max(lx, ly);

    float lod = log2(pixScale);
    float2 scales = float2(exp2(floor(lod)), exp2(ceil(lod)));
    float2 samples = float2(hash3D(floor(scales.x * pos)),
                            hash3D(floor(scales.y * pos)));

    float w = frac(lod);
    float x = (1.0 - w) * samples.x + w * samples.y;

    float a = min(w, 1.0 - w);
    float3 branches;
    branches.x = x * x / (2.0 * a * (1.0 - a));
    branches.y = (x - 0.5 * a) / (1.0 - a);
    branches.z = 1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)));

    float t = branches.z;
    if (x < a)
        t = branches.x;
    else if (x < 1.0 - a)
        t = branches.y;

    t = ceil(t * 20.0) * 0.05;
    return clamp(t, 1.0e-6, 1.0);
}
