#version 330 core
// Listing 1 as a renderer for the desktop holds it: a uniform for the scale, derivatives taken where they are needed.
//
//     hashed-alpha check examples/shaders/listing_sine.glsl --set g_HashScale=1

uniform float g_HashScale;

float hash(vec2 in) {
    return fract(1.0e4 * sin(17.0 * in.x + 0.1 * in.y) * (0.1 + abs(sin(13.0 * in.y + in.x))));
}

float hash3D(const in vec3 p) {
    return hash(vec2(hash(p.xy), p.z));
}

float threshold(in vec3 position) {
    float maxDeriv = max(length(dFdx(position.xyz)), length(dFdy(position.xyz)));
    float pixScale = 1.0 / (g_HashScale * maxDeriv);

    vec2 pixScales = vec2(exp2(floor(log2(pixScale))), exp2(ceil(log2(pixScale))));
    vec2 alpha = vec2(hash3D(floor(pixScales.x * position.xyz)), hash3D(floor(pixScales.y * position.xyz)));

    float lerpFactor = fract(log2(pixScale));
    float x = (1.0 - lerpFactor) * alpha.x + lerpFactor * alpha.y;

    float a = min(lerpFactor, 1.0 - lerpFactor);
    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    float tau = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;
    return clamp(tau, 1.0e-6, 1.0);
}
