#define HASH_SCALE 1.0
#define HASH2(v) fract(1.0e4 * sin(17.0 * (v).x + 0.1 * (v).y) * (0.1 + abs(sin(13.0 * (v).y + (v).x))))

float hash3D(vec3 v)
{
    vec2 k = vec2(HASH2(v.xy), v.z);
    return HASH2(k);
}

float threshold(vec3 position)
{
    // how far the position moves within one pixel
    vec3 moved = max(abs(dFdx(position)), abs(dFdy(position)));
    float maxDeriv = max(moved.x, max(moved.y, moved.z));
    float pixScale = 1.0 / (HASH_SCALE * maxDeriv);

    vec2 pixScales = vec2(exp2(floor(log2(pixScale))),
                          exp2(ceil(log2(pixScale))));

    vec2 alpha = vec2(hash3D(floor(pixScales.x * position)),
                      hash3D(floor(pixScales.y * position)));

    float lerpFactor = fract(log2(pixScale));
    float x = max(alpha.x, alpha.y);

    // inverse transform
    float a = min(lerpFactor, 1.0 - lerpFactor);
    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));

    float t = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;
    return clamp(t, 1.0e-6, 1.0);
}
