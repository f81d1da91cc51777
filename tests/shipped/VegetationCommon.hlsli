// VegetationCommon.hlsli (mobile)
// Everything that's a color is half. Positions aren't, we've been there.

#if defined(SHADER_API_MOBILE) || defined(USE_MIN16)
typedef min16float  half_t;
typedef min16float3 half3_t;
#else
typedef half  half_t;
typedef half3 half3_t;
#endif

cbuffer Vegetation
{
    float3 windDirection;
    float  windTime;
    half3  subsurfaceColor;
    half   subsurfacePower;
    float  noiseScale;
    uint   frameCounter;
};

Texture2D    leafMap;
SamplerState leafSampler;

uint3 Pcg3(uint3 v)
{
    v = v * 1664525u + 1013904223u;

    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;

    v ^= v >> 16u;

    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;

    return v;
}

float RandomOfCell(int3 cell)
{
    return float(Pcg3(uint3(cell)).x >> 8) / 16777216.0;
}

float3 WindOffset(float3 positionWS, half3 vertexColor)
{
    float phase = dot(positionWS, float3(0.13, 0.05, 0.11)) + windTime;
    float flutter = sin(phase * 7.3 + vertexColor.g * 6.28) * 0.05;
    return windDirection * (sin(phase) * 0.5 + 0.5 + flutter) * vertexColor.r;
}

half3 Subsurface(half3 albedo, half3 n, half3 l, half3 v)
{
    half3 h = normalize(l + n * 0.3);
    half  s = pow(saturate(dot(v, -h)), subsurfacePower);
    return albedo * subsurfaceColor * s;
}

// Not half: a threshold of eleven bits isn't enough.
float MakeUniform(float x, float weight)
{
    const float a = min(weight, 1 - weight);
    const float inner = 1 - a;

    if (x >= inner)
        return 1 - (1 - x) * (1 - x) / (2 * a * inner);

    return x < a ? x * x / (2 * a * inner) : (x - a * 0.5) / inner;
}

void ClipHashed(half alpha, float3 positionOS)
{
    float footprint = max(length(ddx(positionOS)), length(ddy(positionOS)));
    float octave = log2(rcp(noiseScale * footprint));

    float2 octaves = float2(floor(octave), ceil(octave));
    float2 scales = exp2(octaves);

    float2 r = float2(RandomOfCell(int3(floor(positionOS * scales.x))),
                      RandomOfCell(int3(floor(positionOS * scales.y))));

    float weight = octave - octaves.x;
    float threshold = MakeUniform(lerp(r.x, r.y, weight), weight);

    clip(alpha - clamp(threshold, 1e-6, 1.0));
}

struct LeafVaryings
{
    float4 positionCS : SV_Position;
    float3 positionOS : TEXCOORD0;
    half3  normalWS   : TEXCOORD1;
    half3  viewWS     : TEXCOORD2;
    float2 uv         : TEXCOORD3;
};

half4 LeafForward(LeafVaryings i, half3 lightDir, half3 lightColor)
{
    half4 leaf = leafMap.Sample(leafSampler, i.uv);
    ClipHashed(leaf.a, i.positionOS);

    half3 n = normalize(i.normalWS);
    half3 lit = leaf.rgb * lightColor * saturate(dot(n, lightDir));
    lit += Subsurface(leaf.rgb, n, lightDir, normalize(i.viewWS)) * lightColor;
    return half4(lit / (1 + lit), 1);
}
