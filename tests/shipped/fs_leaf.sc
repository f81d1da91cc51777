$input v_pos, v_view, v_normal, v_tangent, v_bitangent, v_texcoord0, v_object

/*
 * Leaves with hashed coverage.
 */

#include "../common/common.sh"
#include <bgfx_compute.sh>

SAMPLER2D(s_texColor,  0);
SAMPLER2D(s_texNormal, 1);
SAMPLER2DSHADOW(s_shadowMap, 2);

uniform vec4 u_lightPosRadius[4];
uniform vec4 u_lightRgbInnerR[4];
uniform vec4 u_hashParams; // x: size of the noise in pixels

#define u_hashScale u_hashParams.x

float hash2(vec2 _v)
{
	return fract(1.0e4 * sin(17.0 * _v.x + 0.1 * _v.y) * (0.1 + abs(sin(13.0 * _v.y + _v.x) ) ) );
}

float hash3(vec3 _v)
{
	return hash2(vec2(hash2(_v.xy), _v.z) );
}

float alphaThreshold(vec3 _pos)
{
	float maxDeriv = max(length(dFdx(_pos) ), length(dFdy(_pos) ) );
	float scale = 1.0 / (u_hashScale * maxDeriv);
	float lod = log2(scale);
	vec2 scales = vec2(exp2(floor(lod) ), exp2(ceil(lod) ) );
	vec2 alpha = vec2(hash3(floor(scales.x * _pos) ), hash3(floor(scales.y * _pos) ) );
	float f = fract(lod);
	float x = mix(alpha.x, alpha.y, f);
	float a = min(f, 1.0 - f);
	vec3 cases = vec3(
		  x*x / (2.0*a*(1.0 - a) )
		, (x - 0.5*a) / (1.0 - a)
		, 1.0 - ( (1.0 - x)*(1.0 - x) / (2.0*a*(1.0 - a) ) )
		);
	float result = (x < 1.0 - a)
		? ( (x < a) ? cases.x : cases.y)
		: cases.z
		;
	return clamp(result, 1.0e-6, 1.0);
}

vec2 blinn(vec3 _lightDir, vec3 _normal, vec3 _viewDir)
{
	float ndotl = dot(_normal, _lightDir);
	vec3 reflected = _lightDir - 2.0*ndotl*_normal;
	float rdotv = dot(reflected, _viewDir);
	return vec2(ndotl, rdotv);
}

vec3 calcLight(int _idx, mat3 _tbn, vec3 _wpos, vec3 _normal, vec3 _view)
{
	vec3 lp = u_lightPosRadius[_idx].xyz - _wpos;
	float attn = 1.0 - smoothstep(u_lightRgbInnerR[_idx].w, 1.0, length(lp) / u_lightPosRadius[_idx].w);
	vec3 lightDir = mul(_tbn, normalize(lp) );
	vec2 bln = blinn(lightDir, _normal, _view);
	return u_lightRgbInnerR[_idx].xyz * max(0.0, bln.x) * attn;
}

void main()
{
	vec4 color = toLinear(texture2D(s_texColor, v_texcoord0) );
	if (color.w < alphaThreshold(v_object) )
	{
		discard;
	}

	mat3 tbn = mtxFromCols(v_tangent, v_bitangent, v_normal);
	vec3 normal;
	normal.xy = texture2D(s_texNormal, v_texcoord0).xy * 2.0 - 1.0;
	normal.z = sqrt(1.0 - dot(normal.xy, normal.xy) );

	vec3 lightColor = vec3_splat(0.0);
	for (int ii = 0; ii < 4; ++ii)
	{
		lightColor += calcLight(ii, tbn, v_pos, normal, normalize(v_view) );
	}

	gl_FragColor.xyz = toGamma(max(vec3_splat(0.05), lightColor) * color.xyz);
	gl_FragColor.w = 1.0;
}
