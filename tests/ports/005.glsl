// `origin` is the pivot of the instance, in the same space as `position`.
const uint PRIME32_2 = 2246822519u;
const uint PRIME32_3 = 3266489917u;
const uint PRIME32_4 = 668265263u;
const uint PRIME32_5 = 374761393u;

uint rotl17(uint v)
{
    return (v << 17) | (v >> 15);
}

uint xxhash32(uvec4 p)
{
    uint h = p.w + PRIME32_5 + p.x * PRIME32_3;
    h = PRIME32_4 * rotl17(h);
    h += p.y * PRIME32_3;
    h = PRIME32_4 * rotl17(h);
    h += p.z * PRIME32_3;
    h = PRIME32_4 * rotl17(h);
    h = PRIME32_2 * (h ^ (h >> 15));
    h = PRIME32_3 * (h ^ (h >> 13));
    return h ^ (h >> 16);
}

float noiseAt(vec3 p, float level)
{
    ivec3 c = ivec3(floor(p * exp2(level)));
    uint h = xxhash32(uvec4(uvec3(c), uint(int(level))));
    return float(h >> 8) / 16777216.0;
}

float threshold(vec3 position, vec3 origin)
{
    float maxDeriv = max(length(dFdx(position)), length(dFdy(position)));
    float level = log2(1.0 / maxDeriv);

    float lower = noiseAt(origin, floor(level));
    float upper = noiseAt(origin, floor(level) + 1.0);

    float f = fract(level);
    float x = (1.0 - f) * lower + f * upper;
    float a = min(f, 1.0 - f);
    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    float t = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;
    return clamp(t, 1.0e-6, 1.0);
}
