// Alpha hashing for grass: per-axis octaves keep grains pixel sized on slopes.
float hash(vec2 v)
{
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float hash3D(vec3 v)
{
    return hash(vec2(hash(v.xy), v.z));
}

float finish(float c)
{
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1.0 / 2.4) - 0.055;
}

float threshold(vec3 position)
{
    vec3 ax = abs(dFdx(position));
    vec3 ay = abs(dFdy(position));
    vec3 anisoDeriv = min(ax, ay);
    vec3 anisoScales = 0.707 / max(anisoDeriv, vec3(1e-6));

    vec3 l = log2(anisoScales);
    vec2 alpha = vec2(hash3D(floor(exp2(floor(l)) * position)),
                      hash3D(floor(exp2(ceil(l)) * position)));

    vec3 fractLoc = fract(l);
    float lowDist = length(fractLoc);
    float highDist = length(vec3(1.0) - fractLoc);
    float lerpFactor = lowDist / (lowDist + highDist);

    float x = mix(alpha.x, alpha.y, lerpFactor);
    float a = min(lerpFactor, 1.0 - lerpFactor);
    float t = (x - 0.5 * a) / (1.0 - a);
    if (x < a)
        t = x * x / (2.0 * a * (1.0 - a));
    if (x >= 1.0 - a)
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));

    return clamp(finish(clamp(t, 0.0, 1.0)), 1.0e-6, 1.0);
}
