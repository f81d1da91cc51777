float hash(vec2 v)
{
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float hash3D(vec3 v)
{
    return hash(vec2(hash(v.xy), v.z));
}

float noise3D(vec3 p)
{
    vec3 i = floor(p);
    vec3 f = fract(p);
    vec3 u = f * f * (3.0 - 2.0 * f);
    float n00 = mix(hash3D(i), hash3D(i + vec3(1.0, 0.0, 0.0)), u.x);
    float n10 = mix(hash3D(i + vec3(0.0, 1.0, 0.0)), hash3D(i + vec3(1.0, 1.0, 0.0)), u.x);
    float n01 = mix(hash3D(i + vec3(0.0, 0.0, 1.0)), hash3D(i + vec3(1.0, 0.0, 1.0)), u.x);
    float n11 = mix(hash3D(i + vec3(0.0, 1.0, 1.0)), hash3D(i + vec3(1.0, 1.0, 1.0)), u.x);
    return mix(mix(n00, n10, u.y), mix(n01, n11, u.y), u.z);
}

float threshold(vec3 position)
{
    float maxDeriv = max(length(dFdx(position)), length(dFdy(position)));
    float l = log2(1.0 / maxDeriv);

    float n0 = noise3D(exp2(floor(l)) * position);
    float n1 = noise3D(exp2(ceil(l)) * position);
    float f = fract(l);
    float x = mix(n0, n1, f);

    float a = min(f, 1.0 - f);
    vec3 cases = vec3(x * x / (2.0 * a * (1.0 - a)),
                      (x - 0.5 * a) / (1.0 - a),
                      1.0 - (x * x / (2.0 * a * (1.0 - a))));
    float t = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;
    return clamp(t, 1.0e-6, 1.0);
}
