#define ALPHA_HASH_SCALE 1.0

float hash2D(vec2 value)
{
    return fract(1.0e4 * sin(17.0 * value.x + 0.1 * value.y) * (0.1 + abs(sin(13.0 * value.y + value.x))));
}

float hash3D(vec3 value)
{
    return hash2D(vec2(hash2D(value.xy), value.z));
}

float getAlphaHashThreshold(vec3 position)
{
    vec3 dx = abs(dFdx(position));
    vec3 dy = abs(dFdy(position));
    vec3 deriv = max(dx, dy) * ALPHA_HASH_SCALE;

    vec3 scales = vec3(0.707 / deriv.x, 0.707 / deriv.y, 0.707 / deriv.z);
    vec3 logs = log2(scales);

    float alphaLow = hash3D(floor(exp2(floor(logs)) * position));
    float alphaHigh = hash3D(floor(exp2(ceil(logs)) * position));

    vec3 fractLoc = fract(logs);
    vec2 toCorners = vec2(length(fractLoc), length(vec3(1.0) - fractLoc));
    float f = toCorners.x / (toCorners.x + toCorners.y);

    // interpolate, then undo the bias that interpolating brings
    float x = (1.0 - f) * alphaLow + f * alphaHigh;
    float a = min(f, 1.0 - f);
    vec3 cases = vec3(
        x * x / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)))
    );
    float result = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;
    return clamp(result, 1.0 / 255.0, 1.0);
}
