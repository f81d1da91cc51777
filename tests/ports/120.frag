uint mixWord(uint h, uint k)
{
    k *= 0xcc9e2d51u;
    k = (k << 15) | (k >> 17);
    h ^= k * 0x1b873593u;
    h = (h << 13) | (h >> 19);
    return h * 5u + 0xe6546b64u;
}

uint finalize(uint h)
{
    h ^= h >> 16;
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    h ^= h >> 16;
    return h;
}

float noiseAt(vec3 p, vec3 octave)
{
    ivec3 c = ivec3(floor(p * exp2(octave)));
    ivec3 o = ivec3(octave);
    uint h = 1u;
    h = mixWord(mixWord(mixWord(h, uint(c.x)), uint(c.y)), uint(c.z));
    h = mixWord(mixWord(mixWord(h, uint(o.x)), uint(o.y)), uint(o.z));
    return float(finalize(h ^ 24u) >> 8) / 16777216.0;
}

float threshold(vec3 P, float hash_scale)
{
    vec3 d = hash_scale * max(abs(dFdx(P)), abs(dFdy(P)));
    vec3 level = log2(0.707 / d);
    vec3 flr = floor(level);
    vec3 loc = level - flr;

    float near = length(loc);
    float far = length(vec3(1.0) - loc);
    float w = near / (near + far);
    float x = mix(noiseAt(P, flr), noiseAt(P, flr + 1.0), w);

    float a = min(w, 1.0 - w);
    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)));
    float t = x < a ? cases.x : (x < 1.0 - a ? cases.y : cases.z);
    return clamp(t, 1.0e-6, 1.0);
}
