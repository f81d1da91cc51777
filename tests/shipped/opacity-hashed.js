export default /* glsl */`
uniform float material_opacity;
uniform float alpha_ref;
uniform float material_hashScale;

#ifdef STD_OPACITY_TEXTURE
    uniform sampler2D texture_opacityMap;
#endif

varying vec3 vPositionL;

float hashSine(vec2 p) {
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float hashCell(vec3 p) {
    return hashSine(vec2(hashSine(p.xy), p.z));
}

void opacityDither(float alpha, float id) {
    #if STD_OPACITY_DITHER == BAYER8
        float noise = bayer8(floor(mod(gl_FragCoord.xy, 8.0))) / 64.0;
    #else
        // HASHED: stays on the surface
        float deriv = max(length(dFdx(vPositionL)), length(dFdy(vPositionL)));
        float scale = 1.0 / (material_hashScale * deriv);
        float octave = floor(log2(scale));
        float weight = fract(log2(scale));
        float n0 = hashCell(floor(exp2(octave) * vPositionL));
        float n1 = hashCell(floor(exp2(ceil(log2(scale))) * vPositionL));
        float x = n0 * (1.0 - weight) + n1 * weight;
        float a = min(weight, 1.0 - weight);
        float noise = x < a
            ? x * x / (2.0 * a * (1.0 - a))
            : (x < 1.0 - a
                ? (x - 0.5 * a) / (1.0 - a)
                : 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)));
        noise = clamp(noise, 1.0e-6, 1.0);
    #endif

    if (alpha < noise)
        discard;
}

void getOpacity() {
    dAlpha = 1.0;

    #ifdef STD_OPACITY
        dAlpha *= material_opacity;
    #endif

    #ifdef STD_OPACITY_TEXTURE
        dAlpha *= texture2DBias(texture_opacityMap, vUv0, textureBias).a;
    #endif
}
`;
