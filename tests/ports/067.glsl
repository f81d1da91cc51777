precision highp float;
precision highp int;

uint scramble(uint k)
{
    k *= 0xcc9e2d51u;
    k = (k << 15) | (k >> 17);
    return k * 0x1b873593u;
}

uint murmur(uint id, uint octave)
{
    uint h = 0x9747b28cu;
    h ^= scramble(id);
    h = ((h << 13) | (h >> 19)) * 5u + 0xe6546b64u;
    h ^= scramble(octave);
    h = ((h << 13) | (h >> 19)) * 5u + 0xe6546b64u;
    h ^= 8u;
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return h ^ (h >> 16);
}

float value(uint id, int octave)
{
    return float(murmur(id, uint(octave)) >> 8) / 16777216.0;
}

// object_id: index of the instance in the draw
float threshold(vec3 position, uint object_id)
{
    float maxDeriv = max(length(dFdx(position)), length(dFdy(position)));
    float level = log2(1.0 / max(maxDeriv, 1e-8));
    int o = int(floor(level));
    float w = fract(level);

    float x = mix(value(object_id, o), value(object_id, o + 1), w);

    float a = min(w, 1.0 - w);
    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)));
    float t = (x < 1.0 - a) ? ((x < a) ? cases.x : cases.y) : cases.z;
    return clamp(t, 1.0e-6, 1.0);
}
