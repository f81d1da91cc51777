#if OPENGL
	#define SV_POSITION POSITION
	#define VS_SHADERMODEL vs_3_0
	#define PS_SHADERMODEL ps_3_0
#else
	#define VS_SHADERMODEL vs_4_0
	#define PS_SHADERMODEL ps_4_0
#endif

// Leaves. That's an effect of XNA's days, with the hash added in 2019.

matrix World;
matrix View;
matrix Projection;

float3 SunDirection;
float3 SunColor;
float  HashScale = 1.0;
float  Opacity = 1.0;

Texture2D LeafTexture;
sampler2D LeafSampler = sampler_state
{
	Texture = <LeafTexture>;
	MinFilter = Anisotropic;
	MagFilter = Linear;
	AddressU = Clamp;
	AddressV = Clamp;
};

struct VertexShaderInput
{
	float4 Position : POSITION0;
	float3 Normal : NORMAL0;
	float2 TexCoord : TEXCOORD0;
};

struct VertexShaderOutput
{
	float4 Position : SV_POSITION;
	float3 Normal : TEXCOORD1;
	float2 TexCoord : TEXCOORD0;
	float3 ModelPos : TEXCOORD2;
};

VertexShaderOutput MainVS(in VertexShaderInput input)
{
	VertexShaderOutput output = (VertexShaderOutput)0;
	output.Position = mul(mul(mul(input.Position, World), View), Projection);
	output.Normal = mul(input.Normal, (float3x3)World);
	output.TexCoord = input.TexCoord;
	output.ModelPos = input.Position.xyz;
	return output;
}

float Hash2D(float2 v)
{
	return frac(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float Hash3D(float3 v)
{
	return Hash2D(float2(Hash2D(v.xy), v.z));
}

float4 MainPS(VertexShaderOutput input) : COLOR0
{
	float4 color = tex2D(LeafSampler, input.TexCoord);
	float alpha = color.a * Opacity;

	float3 p = input.ModelPos;
	float deriv = max(length(ddx(p)), length(ddy(p)));
	float pixScale = 1.0 / (HashScale * deriv);
	float2 scales = exp2(float2(floor(log2(pixScale)), ceil(log2(pixScale))));
	float2 noise = float2(Hash3D(floor(scales.x * p)), Hash3D(floor(scales.y * p)));
	float f = frac(log2(pixScale));
	float x = (1.0 - f) * noise.x + f * noise.y;
	float a = min(f, 1.0 - f);
	float3 cases = float3(x * x / (2.0 * a * (1.0 - a)),
		(x - 0.5 * a) / (1.0 - a),
		1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
	float t = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;
	t = clamp(t, 1.0e-6, 1.0);

	clip(alpha - t);

	float light = saturate(dot(normalize(input.Normal), -SunDirection)) * 0.7 + 0.3;
	return float4(color.rgb * SunColor * light, 1);
}

technique LeafDrawing
{
	pass P0
	{
		VertexShader = compile VS_SHADERMODEL MainVS();
		PixelShader = compile PS_SHADERMODEL MainPS();
	}
};
