/*
    Phong with a hashed alpha mask. Needs OpenGL 3.3 / GLES 3.0.
    The defines come in front, from the C++ constructor: "#define ALPHA_MASK\n" and so on
*/

#if (defined(AMBIENT_TEXTURE) || defined(DIFFUSE_TEXTURE)) && !defined(TEXTURED)
#define TEXTURED
#endif

#ifndef NEW_GLSL
#define in varying
#define fragmentColor gl_FragColor
#define texture texture2D
#endif

#ifndef RUNTIME_CONST
#define const
#endif

#ifdef DIFFUSE_TEXTURE
#ifdef EXPLICIT_BINDING
layout(binding = 1)
#endif
uniform lowp sampler2D diffuseTexture;
#endif

#ifdef EXPLICIT_UNIFORM_LOCATION
layout(location = 5)
#endif
uniform lowp vec4 diffuseColor
    #ifndef GL_ES
    = vec4(1.0)
    #endif
    ;

#ifdef EXPLICIT_UNIFORM_LOCATION
layout(location = 6)
#endif
uniform highp float maskScale
    #ifndef GL_ES
    = 1.0
    #endif
    ;

in highp vec3 untransformedPosition;
in mediump vec3 transformedNormal;
#ifdef TEXTURED
in mediump vec2 interpolatedTextureCoordinates;
#endif

#ifdef NEW_GLSL
out lowp vec4 fragmentColor;
#endif

#ifdef OBJECT_ID
flat in highp uint interpolatedObjectId;
out highp uint fragmentObjectId;
#endif

highp uint cellBits(highp ivec3 cell) {
    highp uvec3 v = uvec3(cell)*1664525u + 1013904223u;
    v.x += v.y*v.z; v.y += v.z*v.x; v.z += v.x*v.y;
    v ^= v >> 16u;
    v.x += v.y*v.z; v.y += v.z*v.x; v.z += v.x*v.y;
    return v.x;
}

highp float cellRandom(highp vec3 scaled) {
    return float(cellBits(ivec3(floor(scaled))) >> 8u)*(1.0/16777216.0);
}

highp float blendCdf(const highp float x, const highp float a) {
    const highp float q = 2.0*a*(1.0 - a);
    if(x < a) return x*x/q;
    if(x < 1.0 - a) return (x - 0.5*a)/(1.0 - a);
    return 1.0 - (1.0 - x)*(1.0 - x)/q;
}

void main() {
    lowp vec4 finalDiffuseColor =
        #ifdef DIFFUSE_TEXTURE
        texture(diffuseTexture, interpolatedTextureCoordinates)*
        #endif
        diffuseColor;

    #ifdef ALPHA_MASK
    {
        const highp vec3 p = untransformedPosition;
        const highp float level = -log2(maskScale*max(length(dFdx(p)), length(dFdy(p))));
        const highp float below = floor(level);
        const highp float above = ceil(level);
        const highp float f = level - below;
        const highp float x = mix(cellRandom(exp2(below)*p), cellRandom(exp2(above)*p), f);
        const highp float threshold = clamp(blendCdf(x, min(f, 1.0 - f)), 1.0e-6, 1.0);
        if(all(lessThan(vec2(finalDiffuseColor.a), vec2(threshold)))) discard;
    }
    #endif

    fragmentColor = vec4(finalDiffuseColor.rgb*max(0.0, normalize(transformedNormal).z), 1.0);

    #ifdef OBJECT_ID
    fragmentObjectId = interpolatedObjectId;
    #endif
}
