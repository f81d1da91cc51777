const float kRootHalf = 0.707;

float hash(vec2 p)
{
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float hashOf(vec3 p)
{
    return hash(floor(p).xy);
}

// lerp weight from the place within the cube of neighbouring scales
float weightOf(vec3 loc)
{
    float d0 = length(loc);
    float d1 = length(vec3(1.0) - loc);
    return d0 / (d0 + d1);
}

float threshold(vec3 pos, vec3 dpdx, vec3 dpdy)
{
    vec3 d = max(abs(dpdx), abs(dpdy));
    vec3 scales = vec3(kRootHalf) / d;
    vec3 lg = log2(scales);

    float n0 = hashOf(exp2(floor(lg)) * pos);
    float n1 = hashOf(exp2(ceil(lg)) * pos);
    float w = weightOf(fract(lg));
    float x = mix(n0, n1, w);

    float a = min(w, 1.0 - w);
    vec3 cases = vec3(
        (x * x) / (2.0 * a * (1.0 - a)),
        (x - 0.5 * a) / (1.0 - a),
        1.0 - ((1.0 - x) * (1.0 - x)) / (2.0 * a * (1.0 - a)));
    float t = (x < 1.0 - a) ? ((x < a) ? cases.x : cases.y) : cases.z;
    return clamp(t, 1.0e-6, 1.0);
}
