const float kHashScale = 1.0;
const float kSqrtHalf = 0.70710678;

float hash(vec2 v)
{
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float hash3D(vec3 v) { return hash(vec2(hash(v.xy), v.z)); }

float cdf(float x, float a)
{
    float ends = 2.0 * a * (1.0 - a);
    if (x < a)
        return x * x / ends;
    if (x >= 1.0 - a)
        return 1.0 - (1.0 - x) * (1.0 - x) / ends;
    return (x - 0.5 * a) / (1.0 - a);
}

float getAlphaHashThreshold(vec3 objCoord)
{
    vec3 anisoDeriv = max(abs(dFdx(objCoord)), abs(dFdy(objCoord)));
    vec3 anisoScales = kSqrtHalf / (kHashScale * anisoDeriv);

    vec3 logScales = log2(anisoScales);
    vec3 scaleFlr = exp2(floor(logScales));
    vec3 scaleCeil = exp2(ceil(logScales));

    float h0 = hash3D(floor(scaleFlr * objCoord));
    float h1 = hash3D(floor(scaleCeil * objCoord));

    vec3 fractLoc = fract(logScales);
    float below = length(fractLoc);
    float above = length(vec3(1.0) - fractLoc);
    float w = below / (below + above);

    float x = mix(h0, h1, w);
    return clamp(cdf(x, min(w, 1.0 - w)), 1.0e-6, 1.0);
}
