const uint P2 = 2246822519u;
const uint P3 = 3266489917u;
const uint P4 = 668265263u;
const uint P5 = 374761393u;

uint xxRound(uint h, uint word)
{
    h += word * P3;
    return P4 * ((h << 17) | (h >> 15));
}

float cellHash(vec3 p)
{
    ivec3 c = ivec3(floor(p));
    uint h = P5 + 12u;
    h = xxRound(h, uint(c.x));
    h = xxRound(h, uint(c.y));
    h = xxRound(h, uint(c.z));
    h = P2 * (h ^ (h >> 15));
    h = P3 * (h ^ (h >> 13));
    h ^= h >> 16;
    return float(h >> 8) / 16777216.0;
}

float threshold(vec3 pos)
{
    float d = max(length(dFdx(pos)), length(dFdy(pos)));
    float lod = -log2(max(d, 1e-8));
    float lower = floor(lod);
    float w = lod - lower;

    float n0 = cellHash(pos * exp2(lower));
    float n1 = cellHash(pos * exp2(lower + 1.0));
    float x = n0 + (n1 - n0) * w;

    float a = min(w, 1.0 - w);
    float b = 1.0 - a;
    float t = (x < a) ? x * x / (2.0 * a * b)
            : (x < b) ? (x - 0.5 * a) / b
            : 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * b);
    return clamp(t, 1.0e-6, 1.0);
}
