@piece( DeclHashedCoverage )
@end
#version 330 core
//#include "SyntaxHighlightingMisc.h"

// Ogre-next style; Listing 2 (anisotropic), since our ground's seen at grazing angles

@property( hlms_shadowcaster )
#define SHADOW_CASTER 1
@end

in block
{
	vec3 objPos;
	vec3 worldPos;
	vec2 uv0;
} inPs;

uniform sampler2D diffuseMap;
uniform vec4 passParams;		// x: hash scale, y: time, z: unused, w: unused
uniform float hashScale;

out vec4 outColour;

#define INLINE
#define rshort int

INLINE float hashCov2( vec2 k )
{
	return fract( 1.0e4 * sin( 17.0 * k.x + 0.1 * k.y ) * ( 0.1 + abs( sin( 13.0 * k.y + k.x ) ) ) );
}

INLINE float hashCov3( vec3 k )
{
	return hashCov2( vec2( hashCov2( k.xy ), k.z ) );
}

INLINE float hashedCoverageAniso( vec3 objPos )
{
	// Per axis: the widest step between two neighbouring pixels
	vec3 anisoDeriv = max( abs( dFdx( objPos ) ), abs( dFdy( objPos ) ) );
	vec3 anisoScales = 0.707 / ( hashScale * anisoDeriv );

	vec3 logScales = log2( anisoScales );
	vec3 scaleFlr  = exp2( floor( logScales ) );
	vec3 scaleCeil = exp2( ceil( logScales ) );

	vec2 alpha = vec2( hashCov3( floor( scaleFlr * objPos ) ),
					   hashCov3( floor( scaleCeil * objPos ) ) );

	// How far from either corner of the cell of scales
	vec3 fractLoc = fract( logScales );
	vec2 toCorners = vec2( length( fractLoc ), length( vec3( 1.0 ) - fractLoc ) );
	float lerpFactor = toCorners.x / ( toCorners.x + toCorners.y );

	float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;

	float a = min( lerpFactor, 1.0 - lerpFactor );
	vec3 cases = vec3( x * x / ( 2.0 * a * ( 1.0 - a ) ),
					   ( x - 0.5 * a ) / ( 1.0 - a ),
					   1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) ) );

	float tau = ( x < ( 1.0 - a ) ) ? ( ( x < a ) ? cases.x : cases.y ) : cases.z;
	return clamp( tau, 1.0e-6, 1.0 );
}

@property( !hlms_shadowcaster )
vec3 ambientHemisphere( vec3 n )
{
	float w = n.y * 0.5 + 0.5;
	return mix( vec3( 0.1, 0.09, 0.08 ), vec3( 0.3, 0.35, 0.4 ), w );
}
@end

void main()
{
	vec4 diffuse = texture( diffuseMap, inPs.uv0 );

	if( diffuse.a < hashedCoverageAniso( inPs.objPos ) )
		discard;

@property( hlms_shadowcaster )
	outColour = vec4( gl_FragCoord.z );
@end
@property( !hlms_shadowcaster )
	outColour = vec4( diffuse.rgb * ambientHemisphere( vec3( 0.0, 1.0, 0.0 ) ), 1.0 );
@end
}
