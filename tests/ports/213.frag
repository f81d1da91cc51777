#define GRAIN 1.0

float wave(vec2 v)
{
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float wave3(vec3 v)
{
    return wave(vec2(wave(v.xy), v.z));
}

float blendWeight(vec3 f)
{
    float l0 = length(f);
    float l1 = length(vec3(1.0) - f);
    return l0 / (l0 + l1);
}

float threshold(vec3 position, vec3 dpdx, vec3 dpdy)
{
    vec3 d = max(abs(dpdx), abs(dpdy));
    vec3 lg = -log2(GRAIN * d);
    vec3 base = floor(lg);

    float h0 = wave3(floor(position * exp2(base)));
    float h1 = wave3(floor(position * exp2(base + 1.0)));

    float w = blendWeight(lg - base);
    float x = mix(h0, h1, w);
    float a = min(w, 1.0 - w);

    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)));

    return clamp(x < a ? cases.x : (x < 1.0 - a ? cases.y : cases.z), 1.0e-6, 1.0);
}
