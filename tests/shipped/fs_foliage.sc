$input v_objpos, v_texcoord0, v_normal

/*
 * Foliage with hashed alpha testing.
 */
#include "../common/common.sh"

SAMPLER2D(s_texColor, 0);
uniform vec4 u_foliageParams; // x: hash scale, y: translucency
#define u_hashScale   u_foliageParams.x
#define u_translucency u_foliageParams.y
uniform vec4 u_lightDir;

float hash2(vec2 _v)
{
	return fract(1.0e4 * sin(17.0*_v.x + 0.1*_v.y) * (0.1 + abs(sin(13.0*_v.y + _v.x) ) ) );
}

float hash3(vec3 _v)
{
	return hash2(vec2(hash2(_v.xy), _v.z) );
}

float hashedThreshold(vec3 _pos)
{
	float maxDeriv = max(length(dFdx(_pos) ), length(dFdy(_pos) ) );
	float pixScale = 1.0/(u_hashScale*maxDeriv);
	vec2 pixScales = vec2(exp2(floor(log2(pixScale) ) ), exp2(ceil(log2(pixScale) ) ) );
	vec2 alpha = vec2(hash3(floor(pixScales.x*_pos) ), hash3(floor(pixScales.y*_pos) ) );
	float f = fract(log2(pixScale) );
	float x = mix(alpha.x, alpha.y, f);
	float a = min(f, 1.0-f);
	vec3 cases = vec3(x*x/(2.0*a*(1.0-a) ), (x-0.5*a)/(1.0-a), 1.0-( (1.0-x)*(1.0-x)/(2.0*a*(1.0-a) ) ) );
	float alphaT = (x < (1.0-a) ) ? ( (x < a) ? cases.x : cases.y) : cases.z;
	return clamp(alphaT, 1.0e-6, 1.0);
}

void main()
{
	vec4 color = toLinear(texture2D(s_texColor, v_texcoord0) );
	if (color.w < hashedThreshold(v_objpos) )
	{
		discard;
	}
	vec3 n = normalize(v_normal);
	float ndotl = dot(n, u_lightDir.xyz);
	float lit = max(ndotl, 0.0) + u_translucency*max(-ndotl, 0.0);
	gl_FragColor = toGamma(vec4(color.xyz*lit, 1.0) );
}
