#version 330 core
// Foliage alpha, port of Wyman & McGuire Listing 1.
uniform float uHashScale;

float hash2(vec2 v) {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}
float hash3(vec3 v) {
    return hash2(vec2(hash2(v.xy), v.z));
}

float hashedAlphaThreshold(vec3 objPos) {
    float maxDeriv = max(length(dFdx(objPos)), length(dFdy(objPos)));
    float pixScale = 1.0 / (uHashScale * maxDeriv);
    vec2 pixScales = vec2(exp2(floor(log2(pixScale))), exp2(ceil(log2(pixScale))));
    vec2 alpha = vec2(hash3(pixScales.x * objPos), hash3(floor(pixScales.y * objPos)));
    float lerpFactor = fract(log2(pixScale));
    float x = (1.0 - lerpFactor) * alpha.x + lerpFactor * alpha.y;
    float a = min(lerpFactor, 1.0 - lerpFactor);
    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    float t = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;
    return clamp(t, 1.0e-6, 1.0);
}
