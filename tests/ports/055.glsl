uint pcg(uint v)
{
    uint s = v * 747796405u + 2891336453u;
    uint w = ((s >> ((s >> 28u) + 4u)) ^ s) * 277803737u;
    return (w >> 22u) ^ w;
}

float hash3D(vec3 p)
{
    ivec3 c = ivec3(floor(p));
    uint h = pcg(uint(c.x) + pcg(uint(c.y) + pcg(uint(c.z))));
    return float(h >> 24u) / 255.0;
}

vec2 scalesAndWeight(vec3 fractLoc)
{
    float lowLen = length(fractLoc);
    float highLen = length(1.0 - fractLoc);
    float w = lowLen / (lowLen + highLen);
    return vec2(1.0 - w, w);
}

float threshold(vec3 position, vec3 dpdx, vec3 dpdy)
{
    vec3 anisoDeriv = max(abs(dpdx), abs(dpdy));
    vec3 anisoScales = vec3(0.70710678) / anisoDeriv;
    vec3 lg = log2(anisoScales);

    vec2 w = scalesAndWeight(fract(lg));
    float x = w.x * hash3D(exp2(floor(lg)) * position)
            + w.y * hash3D(exp2(ceil(lg)) * position);

    float a = min(w.x, w.y);
    float t;
    if (x < a)
        t = x * x / (2.0 * a * (1.0 - a));
    else if (x < 1.0 - a)
        t = (x - 0.5 * a) / (1.0 - a);
    else
        t = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));

    return clamp(t, 1.0e-6, 1.0);
}
