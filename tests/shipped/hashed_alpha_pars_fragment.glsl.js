export default /* glsl */`

#ifdef USE_HASHED_COVERAGE

	/*
	 * Stochastic coverage for foliage, after Wyman & McGuire, "Hashed Alpha Testing", 2017.
	 * The noise is anchored to the object, so it doesn't swim when the camera's moved.
	 */

	#ifndef HASHED_COVERAGE_SCALE
		// smaller: finer noise, more shimmer
		#define HASHED_COVERAGE_SCALE 0.05
	#endif

	varying vec3 vCoveragePosition;

	highp float coverageHash( const in vec2 v ) {

		return fract( 1.0e4 * sin( 17.0 * v.x + 0.1 * v.y ) * ( 0.1 + abs( sin( 13.0 * v.y + v.x ) ) ) );

	}

	highp float coverageHash3( const in vec3 v ) {

		return coverageHash( vec2( coverageHash( v.xy ), v.z ) );

	}

	float hashedCoverageThreshold( const in vec3 position ) {

		// Screen footprint of the surface in object space
		float footprint = max(
			length( dFdx( position ) ),
			length( dFdy( position ) )
		);
		float level = log2( 1.0 / ( HASHED_COVERAGE_SCALE * footprint ) );

		// Neighbouring powers of two
		vec2 octaves = exp2( vec2( floor( level ), ceil( level ) ) );

		vec2 noise = vec2(
			coverageHash3( floor( octaves.x * position ) ),
			coverageHash3( floor( octaves.y * position ) )
		);

		float f = fract( level );
		float x = mix( noise.x, noise.y, f );

		// The blend of two uniform values isn't uniform: map through its CDF
		float a = min( f, 1.0 - f );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);

		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;

		return clamp( threshold, 1.0e-6, 1.0 );

	}

#endif

#if defined( USE_FOG ) && ! defined( FOG_EXP2 )

	uniform vec3 fogColor;
	uniform float fogNear;
	uniform float fogFar;

	vec3 coverageFog( const in vec3 color, const in float depth ) {

		return mix( color, fogColor, smoothstep( fogNear, fogFar, depth ) );

	}

#endif
`;
