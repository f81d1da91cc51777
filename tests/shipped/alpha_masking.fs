//------------------------------------------------------------------------------
// Alpha masking for BLEND_MODE_MASKED
//------------------------------------------------------------------------------

#if defined(BLEND_MODE_MASKED) && defined(MATERIAL_HAS_HASHED_ALPHA)
#define HASHED_ALPHA 1
#endif

#if !defined(saturate)
#define saturate(x) clamp(x, 0.0, 1.0)
#endif
#define sq(x) ((x) * (x))

/** @public-api */
struct HashedAlphaParams {
    highp float scale;
    lowp float maskThreshold;
};

uniform HashedAlphaParams hashedAlphaParams;

float computeDiffuseAlpha(float a) {
#if defined(BLEND_MODE_TRANSPARENT) || defined(BLEND_MODE_FADE) || defined(BLEND_MODE_MASKED)
    return a;
#else
    return 1.0;
#endif
}

highp float hash(const highp vec2 v) {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

highp float hash(const highp vec3 v) {
    return hash(vec2(hash(v.xy), v.z));
}

/**
 * Sets the alpha of the given color to 0 or 1. In the average over many pixels what's kept is the alpha
 * that came in.
 *
 * @param position  the position in the model's own space
 */
void applyHashedMask(const highp vec3 position, inout vec4 baseColor) {
    highp vec3 dx = dFdx(position);
    highp vec3 dy = dFdy(position);
    highp float d = max(length(dx), length(dy));
    highp float l = log2(1.0 / (hashedAlphaParams.scale * d));
    highp vec2 s = exp2(vec2(floor(l), ceil(l)));
    highp float w = fract(l);

    highp float x = mix(hash(floor(position * s.x)), hash(floor(position * s.y)), w);
    highp float a = min(w, 1.0 - w);
    highp vec3 c = vec3(
        sq(x) / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - sq(1.0 - x) / (2.0 * a * (1.0 - a)));
    highp float t = x < 1.0 - a ? (x < a ? c.x : c.y) : c.z;
    t = clamp(t, 1.0e-6, 1.0);
    baseColor.a = baseColor.a >= t ? 1.0 : 0.0;
}

#if defined(HASHED_ALPHA)
void applyAlphaMask(inout vec4 baseColor) {
    applyHashedMask(getObjectPosition().xyz, baseColor);
    if (baseColor.a <= 0.0) {
        discard;
    }
}
#else
void applyAlphaMask(inout vec4 baseColor) {
#if defined(BLEND_MODE_MASKED)
    // Use derivatives to sharpen alpha tested edges, combined with alpha to coverage
    baseColor.a = (baseColor.a - getMaskThreshold()) / max(fwidth(baseColor.a), 1e-3) + 0.5;
    if (baseColor.a <= getMaskThreshold()) {
        discard;
    }
#endif
}
#endif

vec4 evaluateMaterial(const MaterialInputs material) {
    PixelParams pixel;
    getPixelParams(material, pixel);
    vec4 color = evaluateLights(material);
    color.rgb += material.emissive.rgb * frameUniforms.exposure;
    return color;
}
