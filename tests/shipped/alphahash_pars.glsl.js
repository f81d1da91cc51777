/**
 * Shader chunks for `material.alphaHash`. The fragment chunk goes behind <map_fragment> and <opacity_fragment>,
 * since it wants the final `diffuseColor.a`.
 */
export const alphahash_pars_vertex = /* glsl */`
#ifdef USE_ALPHAHASH
	varying vec3 vLocalPos;
#endif
`;

export const alphahash_vertex = /* glsl */`
#ifdef USE_ALPHAHASH
	// 'transformed' isn't morphed or skinned yet
	vLocalPos = vec3( transformed );
#endif
`;

export const alphahash_pars_fragment = /* glsl */`
#ifdef USE_ALPHAHASH

	varying vec3 vLocalPos;

	#define GRAIN_SIZE 0.5 // in pixels; below one it's almost plain white noise, which TAA likes

	float whiteNoise2( vec2 v ) {

		return fract( 1.0e4 * sin( 17.0 * v.x + 0.1 * v.y ) * ( 0.1 + abs( sin( 13.0 * v.y + v.x ) ) ) );

	}

	float whiteNoise3( vec3 v ) {

		return whiteNoise2( vec2( whiteNoise2( v.xy ), v.z ) );

	}

	float getHashedThreshold( vec3 position ) {

		vec3 ddx = dFdx( position );
		vec3 ddy = dFdy( position );
		float widest = sqrt( max( dot( ddx, ddx ), dot( ddy, ddy ) ) );

		float octave = log2( 1.0 / ( GRAIN_SIZE * widest ) );
		float base = exp2( floor( octave ) );
		float weight = fract( octave );

		float x = mix(
			whiteNoise3( floor( base * position ) ),
			whiteNoise3( floor( 2.0 * base * position ) ),
			weight
		);

		float a = min( weight, 1.0 - weight );
		float b = 1.0 - a;

		return clamp(
			x < a ? x * x / ( 2.0 * a * b )
			: x < b ? ( x - 0.5 * a ) / b
			: 1.0 - ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * b ),
			1.0e-6, 1.0 );

	}

#endif
`;

export const alphahash_fragment = /* glsl */`
#ifdef USE_ALPHAHASH

	if ( diffuseColor.a < getHashedThreshold( vLocalPos ) ) discard;

#endif
`;

export default {
	alphahash_pars_vertex,
	alphahash_vertex,
	alphahash_pars_fragment,
	alphahash_fragment,
};
