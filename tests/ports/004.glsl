// Order-independent cutouts for vegetation with strong anisotropy.

#define HASH_SCALE 1.0
#define SQRT_HALF 0.70710678

float hash(vec2 v)
{
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float hash3D(vec3 v)
{
    return hash(vec2(hash(v.xy), v.z));
}

float remap(float x, float w)
{
    float a = min(w, 1.0 - w);
    float den = 2.0 * a * (1.0 - a);
    if (x < a) return x * x / den;
    if (x < 1.0 - a) return (x - 0.5 * a) / (1.0 - a);
    return 1.0 - (1.0 - x) * (1.0 - x) / den;
}

float threshold(vec3 position)
{
    vec3 anisoDeriv = max(abs(dFdx(position)), abs(dFdy(position)));
    anisoDeriv = max(anisoDeriv, vec3(1e-7));
    vec3 anisoScales = SQRT_HALF / (HASH_SCALE * anisoDeriv);

    vec3 level = log2(anisoScales);
    vec3 base = floor(level + 0.5);
    vec3 scaleFlr = exp2(base);
    vec3 scaleCeil = exp2(base + 1.0);

    float n0 = hash3D(floor(scaleFlr * position));
    float n1 = hash3D(floor(scaleCeil * position));

    vec3 fractLoc = fract(level);
    vec2 toCorners = vec2(length(fractLoc), length(vec3(1.0) - fractLoc));
    float w = toCorners.x / (toCorners.x + toCorners.y);

    return clamp(remap((1.0 - w) * n0 + w * n1, w), 1.0e-6, 1.0);
}
