#define HASH_SCALE 1.0

float hash(vec2 v) {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float hash3D(vec3 v) {
    return hash(vec2(hash(v.xy), v.z));
}

float threshold(vec3 position, vec3 dpdx, vec3 dpdy) {
    // Find the discretized derivatives of our coordinates
    float maxDeriv = max(length(dpdx), length(dpdy));
    float pixScale = 1.0 / (HASH_SCALE * maxDeriv);

    // Find two nearest log-discretized noise scales
    vec2 pixScales = vec2(exp2(floor(log2(pixScale))), exp2(ceil(log2(pixScale))));

    // Compute alpha thresholds at our two noise scales
    vec2 alpha = vec2(hash3D(floor(pixScales.x * position)), hash3D(floor(pixScales.y * position)));

    // Factor to interpolate lerp with
    float lerpFactor = fract(log2(pixScale));

    // Interpolate alpha threshold from noise at two scales
    float x = (1.0 - lerpFactor) * alpha.x + lerpFactor * alpha.y;

    // Pass into CDF to compute uniformly distrib threshold
    float a = min(lerpFactor, 1.0 - lerpFactor);
    vec3 cases = vec3(x * x / (a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - ((1.0 - x) * (1.0 - x) / (a * (1.0 - a))));

    // Find our final, uniformly distributed alpha threshold
    float t = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;
    return clamp(t, 1.0e-6, 1.0);
}
