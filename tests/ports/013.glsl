const float HASH_SCALE = 1.0;

float hash(vec2 v)
{
    return fract(1.0e4 * sin(17.0 * v.x + v.y * 0.1) * (0.1 + abs(sin(v.y * 13.0 + v.x))));
}

float hash3D(vec3 v) { return hash(vec2(hash(v.xy), v.z)); }

float threshold(vec3 position, vec3 dpdx, vec3 dpdy)
{
    vec3 anisoDeriv = max(abs(dpdx), abs(dpdy));
    vec3 anisoScales = vec3(0.707 / (HASH_SCALE * anisoDeriv.x),
                            0.707 / (HASH_SCALE * anisoDeriv.y),
                            0.707 / (HASH_SCALE * anisoDeriv.z));

    vec3 scaleFlr = exp2(floor(log2(anisoScales)));
    vec3 scaleCeil = exp2(ceil(log2(anisoScales)));
    vec2 alpha = vec2(hash3D(floor(scaleFlr * position)),
                      hash3D(floor(scaleCeil * position)));

    vec3 fractLoc = fract(log2(anisoScales));
    vec2 toCorners = vec2(length(fractLoc), length(vec3(1.0) - fractLoc));
    float lerpFactor = toCorners.x / (toCorners.x + toCorners.y);

    float x = (1.0 - lerpFactor) * alpha.x + lerpFactor * alpha.y;

    float a = min(lerpFactor, 1.0 - lerpFactor);
    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
    float t = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;

    return clamp(t, 1.0e-6, 0.98);
}
