#if OPENGL
	#define SV_POSITION POSITION
	#define VS_SHADERMODEL vs_3_0
	#define PS_SHADERMODEL ps_3_0
#else
	#define VS_SHADERMODEL vs_4_0_level_9_3
	#define PS_SHADERMODEL ps_4_0_level_9_3
#endif

#include "Macros.fxh"

#define MAX_LIGHTS 3

matrix World;
matrix WorldViewProjection;
float3 EyePosition;
float4 DiffuseColor = float4(1, 1, 1, 1);
float3 AmbientLight = float3(0.15, 0.17, 0.2);
float3 LightDirection[MAX_LIGHTS];
float3 LightColor[MAX_LIGHTS];
float3 FogColor;
float2 FogRange = float2(50, 400);
float HashScale = 1.0;
float Time;

texture2D Texture;
sampler2D TextureSampler = sampler_state
{
	Texture = <Texture>;
	MinFilter = Linear;
	MagFilter = Linear;
	MipFilter = Linear;
	AddressU = Wrap;
	AddressV = Wrap;
};

struct VSInput
{
	float4 Position : POSITION0;
	float3 Normal : NORMAL0;
	float2 TexCoord : TEXCOORD0;
};

struct VSOutput
{
	float4 Position : SV_POSITION;
	float2 TexCoord : TEXCOORD0;
	float3 Normal : TEXCOORD1;
	float3 ObjectPosition : TEXCOORD2;
	float Distance : TEXCOORD3;
};

VSOutput MainVS(VSInput input)
{
	VSOutput output = (VSOutput)0;
	float4 p = input.Position;
	p.x += sin(Time + p.y) * 0.03 * p.y;
	output.Position = mul(p, WorldViewProjection);
	output.TexCoord = input.TexCoord;
	output.Normal = mul(input.Normal, (float3x3)World);
	output.ObjectPosition = input.Position.xyz;
	output.Distance = distance(mul(p, World).xyz, EyePosition);
	return output;
}

float Hash2(float2 v)
{
	return frac(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float Hash3(float3 v)
{
	return Hash2(float2(Hash2(v.xy), v.z));
}

float HashedThreshold(float3 position)
{
	float deriv = max(length(ddx(position)), length(ddy(position)));
	float scale = 1.0 / (HashScale * deriv);
	float lod = log2(scale);
	float2 scales = float2(exp2(floor(lod)), exp2(ceil(lod)));
	float2 alpha = float2(Hash3(floor(scales.x * position)), Hash3(floor(scales.y * position)));
	float f = frac(lod);
	float x = f * alpha.x + (1.0 - f) * alpha.y;
	float a = min(f, 1.0 - f);
	float k = 2.0 * a * (1.0 - a);
	float t = x < 1.0 - a ? (x < a ? x * x / k : (x - 0.5 * a) / (1.0 - a)) : 1.0 - (1.0 - x) * (1.0 - x) / k;
	return clamp(t, 1.0e-6, 1.0);
}

float4 MainPS(VSOutput input) : COLOR
{
	float4 color = tex2D(TextureSampler, input.TexCoord) * DiffuseColor;
	clip(color.a - HashedThreshold(input.ObjectPosition));

	float3 normal = normalize(input.Normal);
	float3 light = AmbientLight;
	[unroll]
	for (int i = 0; i < MAX_LIGHTS; i++)
		light += saturate(abs(dot(normal, -LightDirection[i]))) * LightColor[i];

	color.rgb *= light;
	float fog = saturate((input.Distance - FogRange.x) / (FogRange.y - FogRange.x));
	color.rgb = lerp(color.rgb, FogColor, fog);
	return float4(color.rgb, 1);
}

float4 DepthPS(VSOutput input) : COLOR
{
	float alpha = tex2D(TextureSampler, input.TexCoord).a * DiffuseColor.a;
	clip(alpha - HashedThreshold(input.ObjectPosition));
	return float4(input.Distance, 0, 0, 1);
}

technique Foliage
{
	pass P0
	{
		VertexShader = compile VS_SHADERMODEL MainVS();
		PixelShader = compile PS_SHADERMODEL MainPS();
	}
};

technique FoliageDepth
{
	pass P0
	{
		VertexShader = compile VS_SHADERMODEL MainVS();
		PixelShader = compile PS_SHADERMODEL DepthPS();
	}
};
