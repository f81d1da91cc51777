#define HASH_SCALE 1.0

float hash(const vec2 value)
{
    float s = sin(17.0 * value.x + 0.1 * value.y);
    float t = sin(13.0 * value.y + value.x);
    return fract(1.0e4 * s * (0.1 + abs(t)));
}

float hashCell(const vec3 c)
{
    float xy = hash(c.xy);
    return hash(vec2(xy, c.z));
}

float getAlphaThreshold(vec3 position, vec3 dpdx, vec3 dpdy)
{
    float deriv = max(length(dpdx), length(dpdy));
    float pixScale = 1.0 / (HASH_SCALE * deriv);

    vec2 scales = exp2(vec2(floor(log2(pixScale)), ceil(log2(pixScale))));
    vec2 alpha = vec2(hashCell(floor(scales.x * position)),
                      hashCell(floor(scales.y * position)));

    float f = fract(log2(pixScale));
    float x = (1.0 - f) * alpha.x + f * alpha.y;

    float a = min(f, 1.0 - f);
    float slope = 1.0 / (1.0 - a);
    float t = x < a ? 0.5 * slope * x * x / a : slope * (x - 0.5 * a);
    if (x >= 1.0 - a)
        t = 1.0 - 0.5 * slope * (1.0 - x) * (1.0 - x) / a;

    return clamp(t, 1.0e-6, 1.0);
}
