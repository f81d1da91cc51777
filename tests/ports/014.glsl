uint xx(uvec3 p)
{
    const uint P2 = 2246822519U, P3 = 3266489917U;
    const uint P4 = 668265263U, P5 = 374761393U;
    uint h = p.z + P5 + p.x * P3;
    h = P4 * ((h << 17) | (h >> (32 - 17)));
    h += p.y * P3;
    h = P4 * ((h << 17) | (h >> (32 - 17)));
    h = P2 * (h ^ (h >> 15));
    h = P3 * (h ^ (h >> 13));
    return h ^ (h >> 16);
}

float cellHash(vec3 p)
{
    uvec3 c = uvec3(ivec3(floor(p)));
    return float(xx(c) >> 8) / 16777216.0;
}

float threshold(vec3 worldPos)
{
    float deriv = max(length(dFdx(worldPos)), length(dFdy(worldPos)));
    float octave = log2(1.0 / max(deriv, 1.0e-8));

    float whole = floor(octave);
    float part = octave - whole;

    float s = exp2(whole);
    float a0 = cellHash(worldPos * s);
    float a1 = cellHash(worldPos * (s * 4.0));

    float x = mix(a0, a1, part);

    // spread evenly over the unit range
    float t = smoothstep(0.0, 1.0, x);

    return clamp(t, 1.0e-6, 1.0);
}
