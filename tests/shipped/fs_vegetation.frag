// Vegetation, forward pass. 5" wide blades, don't sort; "quoted once
// Varyings as in varying.def, written out (no $input here).
#include "../common/common.sh"
#include "shadow.sh"

SAMPLER2D(s_albedo,  0);
SAMPLER2D(s_normals, 1);
SAMPLER2DSHADOW(s_shadowMap, 2);

uniform vec4 u_params0;
uniform vec4 u_lightDir;
uniform vec4 u_lightColor;

#define u_hashScale   u_params0.x
#define u_shadowBias  u_params0.y
#define u_translucent u_params0.z

varying vec3 v_opos;
varying vec3 v_wpos;
varying vec3 v_normal;
varying vec2 v_texcoord0;

#ifndef BGFX_SHADER_LANGUAGE_HLSL
#	define VEG_DDX(_v) dFdx(_v)
#	define VEG_DDY(_v) dFdy(_v)
#else
#	define VEG_DDX(_v) ddx(_v)
#	define VEG_DDY(_v) ddy(_v)
#endif

float vegHash(vec2 _v)
{
	return fract(1.0e4 * sin(17.0 * _v.x + 0.1 * _v.y) * (0.1 + abs(sin(13.0 * _v.y + _v.x) ) ) );
}

float vegHash3(vec3 _v)
{
	return vegHash(vec2(vegHash(_v.xy), _v.z) );
}

float vegClamp(float _t)
{
	return clamp(_t, 1.0e-6, 1.0);
}

float vegThreshold(vec3 _opos, float _hashScale)
{
	float maxDeriv = max(length(VEG_DDX(_opos) ), length(VEG_DDY(_opos) ) );
	float pixScale = 1.0 / (_hashScale * maxDeriv);

	float lod      = log2(pixScale);
	float scale0   = exp2(floor(lod) );
	float scale1   = exp2(ceil(lod) );
	float noise0   = vegHash3(floor(_opos * scale0) );
	float noise1   = vegHash3(floor(_opos * scale1) );

	float t = fract(lod);
	float x = mix(noise0, noise1, t);
	float a = min(t, 1.0 - t);

	if (x < a)
	{
		return vegClamp(x * x / (2.0 * a * (1.0 - a) ) );
	}

	if (x < 1.0 - a)
	{
		return vegClamp( (x - 0.5 * a) / (1.0 - a) );
	}

	float y = 1.0 - x;
	return vegClamp(1.0 - y * y / (2.0 * a * (1.0 - a) ) );
}

vec3 vegLight(vec3 _albedo, vec3 _normal, float _visibility)
{
	float ndotl = dot(_normal, -u_lightDir.xyz);
	float front = max(ndotl, 0.0);
	float back  = max(-ndotl, 0.0) * u_translucent;
	return _albedo * u_lightColor.xyz * (front + back) * _visibility;
}

void main()
{
	vec4 albedo = texture2D(s_albedo, v_texcoord0);
	if (albedo.w < vegThreshold(v_opos, u_hashScale) )
	{
		discard;
	}

	vec3 normal = normalize(v_normal);
	float visibility = PCF(s_shadowMap, v_wpos, u_shadowBias);
	gl_FragColor = vec4(vegLight(albedo.xyz, normal, visibility), 1.0);
}
