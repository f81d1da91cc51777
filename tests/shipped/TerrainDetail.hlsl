// Terrain details (pebbles, clover, fallen leaves). Runs on phones, so half wherever it doesn't hurt.
//
// #pragma multi_compile _ DETAIL_HASHED
// #pragma multi_compile_fog

#define DETAIL_LAYERS 4
#define HASH_SCALE 1.0

Texture2DArray detailAlbedo : register(t0);
Texture2D      splatMap     : register(t1);
SamplerState   samp         : register(s0);

cbuffer DetailParams : register(b0)
{
    float4x4 viewProj;
    float4   layerTiling[DETAIL_LAYERS];
    float3   sunDirection;
    float    detailDistance;
    half3    sunColor;
    half     wetness;
    half3    skyColor;
    half     cutoff;
};

struct DetailV2F
{
    float4 pos      : SV_Position;
    half3  posOS    : TEXCOORD0;
    half3  normal   : TEXCOORD1;
    float3 uvLayer  : TEXCOORD2;
    float2 splatUV  : TEXCOORD3;
    float  distance : TEXCOORD4;
};

half3 Darken(half3 c, half amount)
{
    return c * lerp(1.0h, 0.55h, amount);
}

half Fade(float d)
{
    return saturate((detailDistance - d) / (0.2 * detailDistance));
}

#ifdef DETAIL_HASHED
float R2(float2 v) { return frac(1e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x)))); }
float R3(float3 v) { return R2(float2(R2(v.xy), v.z)); }

half DetailCutoff(half3 posOS)
{
    float3 p = posOS;
    float  m = max(length(ddx(p)), length(ddy(p)));
    float  s = 1.0 / (HASH_SCALE * m);
    float  lg = log2(s), fl = floor(lg), ce = ceil(lg);

    float  w = frac(lg);
    float  x = lerp(R3(floor(p * exp2(fl))), R3(floor(p * exp2(ce))), w);

    float  a = min(w, 1.0 - w);
    float3 c = { x * x / (2.0 * a * (1.0 - a)),
                 (x - 0.5 * a) / (1.0 - a),
                 1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))) };
    float  t = c.z;
    if (x < 1.0 - a) t = c.y;
    if (x < a)       t = c.x;

    return (half)clamp(t, 1e-6, 1.0);
}
#else
half DetailCutoff(half3 posOS) { return cutoff; }
#endif

half4 DetailPS(DetailV2F i) : SV_Target
{
    half4 c = detailAlbedo.Sample(samp, i.uvLayer);
    half4 splat = splatMap.Sample(samp, i.splatUV);
    c.a *= splat[(uint)i.uvLayer.z & 3] * Fade(i.distance);

    clip(c.a - DetailCutoff(i.posOS));

    half3 n = normalize(i.normal);
    half  ndl = saturate(dot(n, (half3)sunDirection));
    half3 lit = Darken(c.rgb, wetness) * (sunColor * ndl + skyColor);
    return half4(lit, 1.0h);
}
