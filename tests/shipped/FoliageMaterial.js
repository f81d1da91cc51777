import {
	Color,
	DoubleSide,
	ShaderChunk,
	ShaderLib,
	ShaderMaterial,
	UniformsLib,
	UniformsUtils
} from 'three';

/**
 * Foliage material with order-independent cut-outs.
 *
 * The coverage of a fragment is compared with a threshold that is a hash of
 * the object-space position; see Wyman and McGuire, "Hashed Alpha Testing".
 */

const hashedalpha_pars_fragment = /* glsl */`
#ifdef USE_HASHED_ALPHA

	uniform float hashedAlphaScale;

	float haRand2( vec2 v ) {

		return fract( 1.0e4 * sin( 17.0 * v.x + 0.1 * v.y ) * ( 0.1 + abs( sin( 13.0 * v.y + v.x ) ) ) );

	}

	float haRand3( vec3 v ) {

		return haRand2( vec2( haRand2( v.xy ), v.z ) );

	}

	float getHashedAlphaThreshold( vec3 position ) {

		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( hashedAlphaScale * maxDeriv );

		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);

		vec2 alpha = vec2(
			haRand3( floor( pixScales.x * position.xyz ) ),
			haRand3( floor( pixScales.y * position.xyz ) )
		);

		float lerpFactor = fract( log2( pixScale ) );

		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;

		float a = min( lerpFactor, 1.0 - lerpFactor );
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
`;

const hashedalpha_fragment = /* glsl */`
#ifdef USE_HASHED_ALPHA

	if ( diffuseColor.a < getHashedAlphaThreshold( vFoliagePosition ) ) discard;

#endif
`;

ShaderChunk.hashedalpha_pars_fragment = hashedalpha_pars_fragment;
ShaderChunk.hashedalpha_fragment = hashedalpha_fragment;

const vertexShader = /* glsl */`
#define LAMBERT
varying vec3 vViewPosition;
varying vec3 vFoliagePosition;
uniform float windTime;

#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <skinning_pars_vertex>

void main() {

	#include <uv_vertex>
	#include <beginnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>

	vFoliagePosition = position;
	transformed.x += sin( windTime + position.y * 0.5 ) * 0.02 * position.y;

	#include <skinning_vertex>
	#include <project_vertex>

	vViewPosition = - mvPosition.xyz;

	#include <fog_vertex>

}
`;

const fragmentShader = /* glsl */`
#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
varying vec3 vFoliagePosition;

#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <hashedalpha_pars_fragment>

void main() {

	vec4 diffuseColor = vec4( diffuse, opacity );
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;

	#include <map_fragment>
	#include <alphamap_fragment>
	#include <hashedalpha_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_end>

	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;

	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>

}
`;

class FoliageMaterial extends ShaderMaterial {

	constructor( parameters = {} ) {

		super( {
			type: 'FoliageMaterial',
			defines: { USE_HASHED_ALPHA: '' },
			uniforms: UniformsUtils.merge( [
				UniformsLib.common,
				UniformsLib.fog,
				UniformsLib.lights,
				{ hashedAlphaScale: { value: 1.0 }, windTime: { value: 0 }, emissive: { value: new Color( 0x000000 ) } }
			] ),
			vertexShader,
			fragmentShader,
			lights: true,
			fog: true,
			side: DoubleSide
		} );

		this.setValues( parameters );

	}

}

export { FoliageMaterial };
