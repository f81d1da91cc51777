uint jenkins(uint x)
{
    x += x << 10u;
    x ^= x >> 6u;
    x += x << 3u;
    x ^= x >> 11u;
    x += x << 15u;
    return x;
}

float random(vec3 p, float scale)
{
    uvec3 c = uvec3(ivec3(floor(p * scale)));
    uint h = jenkins(floatBitsToUint(scale));
    h = jenkins(h ^ c.x);
    h = jenkins(h ^ c.y);
    h = jenkins(h ^ c.z);
    h = jenkins(h);
    return float(h >> 8u) / 16777216.0;
}

float threshold(vec3 worldPos)
{
    float maxDeriv = max(length(dFdx(worldPos)), length(dFdy(worldPos)));
    float pixScale = 1.0 / max(maxDeriv, 1e-8);

    float lg = log2(pixScale);
    float s0 = exp2(floor(lg));
    float s1 = s0 + s0;
    float f = fract(lg);

    float r0 = random(worldPos, s0);
    float r1 = random(worldPos, s1);
    float x = mix(r0, r1, f);

    float a = min(f, 1.0 - f);
    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    float t = (x < 1.0 - a) ? ((x < a) ? cases.x : cases.y) : cases.z;
    return clamp(t, 1.0e-6, 1.0);
}
