#version 450 core
#extension GL_GOOGLE_include_directive : enable
#extension GL_ARB_separate_shader_objects : enable

// Surface times light: one call per light that touches a surface.

#include "global_inc.glsl"

#if !defined( r_hashedAlpha )
#define r_hashedAlpha 1
#endif

#define saturate( x ) clamp( x, 0.0, 1.0 )
#define lerp mix

layout( set = 0, binding = 0, std140 ) uniform parms_t {
	vec4 rpScreenCorrectionFactor;
	vec4 rpWindowCoord;
	vec4 rpDiffuseModifier;
	vec4 rpSpecularModifier;
	vec4 rpLocalLightOrigin;
	vec4 rpLocalViewOrigin;
	vec4 rpLightProjectionS;
	vec4 rpLightProjectionT;
	vec4 rpLightProjectionQ;
	vec4 rpVertexColorModulate;
	vec4 rpVertexColorAdd;
	vec4 rpColor;
	vec4 rpAlphaTest;		// x: threshold, y: size of the hash in pixels
	vec4 rpJitter;
} parms;

layout( set = 1, binding = 0 ) uniform sampler2D samp0; // bump
layout( set = 1, binding = 1 ) uniform sampler2D samp1; // light falloff
layout( set = 1, binding = 2 ) uniform sampler2D samp2; // light projection
layout( set = 1, binding = 3 ) uniform sampler2D samp3; // diffuse
layout( set = 1, binding = 4 ) uniform sampler2D samp4; // specular

layout( location = 0 ) in vec4 vofi_TexCoord0;
layout( location = 1 ) in vec4 vofi_TexCoord1;
layout( location = 2 ) in vec4 vofi_TexCoord2;
layout( location = 3 ) in vec4 vofi_TexCoord3;
layout( location = 4 ) in vec4 vofi_ObjectPos;
layout( location = 5 ) in vec4 vofi_Color;

layout( location = 0 ) out vec4 fo_FragColor;

float HashSin2( vec2 v ) {
	return fract( 1.0e4 * sin( 17.0 * v.x + 0.1 * v.y ) * ( 0.1 + abs( sin( 13.0 * v.y + v.x ) ) ) );
}

float HashSin3( vec3 v ) {
	return HashSin2( vec2( HashSin2( v.xy ), v.z ) );
}

float UniformFromLerp( float x, float t ) {
	float a = min( t, 1.0 - t );
	if ( x >= 1.0 - a ) {
		return 1.0 - ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) );
	}
	if ( x >= a ) {
		return ( x - 0.5 * a ) / ( 1.0 - a );
	}
	return x * x / ( 2.0 * a * ( 1.0 - a ) );
}

void main() {
	vec4 bumpMap =		texture( samp0, vofi_TexCoord0.xy );
	vec4 lightFalloff =	texture( samp1, vec2( vofi_TexCoord1.x, 0.5 ) );
	vec4 lightProj =	textureProj( samp2, vofi_TexCoord2.xyw );
	vec4 diffuseMap =	texture( samp3, vofi_TexCoord0.zw ) * parms.rpColor;
	vec4 specMap =		texture( samp4, vofi_TexCoord3.xy );

#if r_hashedAlpha
	{
		vec3 objCoord = vofi_ObjectPos.xyz;
		float maxDeriv = max( length( dFdx( objCoord ) ), length( dFdy( objCoord ) ) );
		float level = -log2( parms.rpAlphaTest.y * maxDeriv );
		float threshold[2];
		for ( int i = 0; i < 2; i++ ) {
			float octave = ( i == 0 ) ? floor( level ) : ceil( level );
			threshold[i] = HashSin3( floor( exp2( octave ) * objCoord ) );
		}
		float t = fract( level );
		float alphaTest = UniformFromLerp( lerp( threshold[0], threshold[1], t ), t );
		alphaTest = clamp( alphaTest, 1.0e-6, 1.0 );
		if ( diffuseMap.a < alphaTest ) {
			discard;
		}
	}
#else
	if ( diffuseMap.a < parms.rpAlphaTest.x ) {
		discard;
	}
#endif

	vec3 lightVector = normalize( parms.rpLocalLightOrigin.xyz - vofi_ObjectPos.xyz );
	vec3 viewVector = normalize( parms.rpLocalViewOrigin.xyz - vofi_ObjectPos.xyz );
	vec3 halfAngle = normalize( lightVector + viewVector );

	vec3 localNormal;
	localNormal.xy = bumpMap.wy - 0.5;
	localNormal.z = sqrt( abs( dot( localNormal.xy, localNormal.xy ) - 0.25 ) );
	localNormal = normalize( localNormal );

	float lambert = saturate( dot( localNormal, lightVector ) );
	float hDotN = dot( localNormal, halfAngle );
	vec3 specular = specMap.xyz * pow( max( hDotN, 0.0 ), 10.0 ) * parms.rpSpecularModifier.xyz;
	vec3 diffuse = diffuseMap.xyz * parms.rpDiffuseModifier.xyz;
	vec3 lightColor = lambert * lightProj.xyz * lightFalloff.xyz;

	fo_FragColor = vec4( ( diffuse + specular ) * lightColor * vofi_Color.rgb, 1.0 );
}
