uint hashWord(uint x)
{
    x += (x << 10u);
    x ^= (x >> 6u);
    x += (x << 3u);
    x ^= (x >> 11u);
    x += (x << 15u);
    return x;
}

uint hashWords(uvec4 v)
{
    return hashWord(hashWord(v.x ^ hashWord(v.y ^ hashWord(v.z ^ hashWord(v.w)))));
}

// 23 random mantissa bits below an exponent of zero
float unitFloat(uint m)
{
    return uintBitsToFloat((m >> 9u) | 0x3f800000u) - 1.0;
}

float octaveNoise(vec3 p, float octave)
{
    uvec3 cell = uvec3(ivec3(floor(p * exp2(octave))));
    return unitFloat(hashWords(uvec4(cell, floatBitsToUint(octave))));
}

float threshold(vec3 position)
{
    float width = max(length(dFdx(position)), length(dFdy(position)));
    float octave = -log2(width);
    float o0 = floor(octave);
    float w = fract(octave);

    float x = mix(octaveNoise(position, o0), octaveNoise(position, o0 + 1.0), w);

    float a = min(w, 1.0 - w);
    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    float t = (x < 1.0 - a) ? ((x < a) ? cases.y : cases.x) : cases.z;
    return clamp(t, 1.0e-6, 1.0);
}
