struct OctavePair
{
    float lower;
    float upper;
    float weight;
};

float Hash(float2 n)
{
    return frac(1.0e4 * sin(17.0 * n.x + 0.1 * n.y) * (0.1 + abs(sin(13.0 * n.y + n.x))));
}

float Hash(float3 n)
{
    return Hash(float2(Hash(n.xy), n.z));
}

OctavePair FindOctaves(float deriv)
{
    float l = log2(1.0 / deriv);
    OctavePair o;
    o.lower = exp2(floor(l));
    o.upper = exp2(ceil(l));
    o.weight = frac(l);
    return o;
}

float CellHash(float3 p)
{
    float3 cell = float3(int3(round(p)));
    return Hash(cell);
}

float threshold(float3 pos)
{
    OctavePair o = FindOctaves(max(length(ddx(pos)), length(ddy(pos))));

    float x = lerp(CellHash(pos * o.lower), CellHash(pos * o.upper), o.weight);

    float a = min(o.weight, 1.0 - o.weight);
    float3 cases = float3(x * x / (2.0 * a * (1.0 - a)),
                          (x - 0.5 * a) / (1.0 - a),
                          1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    float t = x < a ? cases.x : (x < 1.0 - a ? cases.y : cases.z);
    return clamp(t, 1.0e-6, 1.0);
}
