// Screen-door transparency with noise anchored to the object.
float hash(vec2 v)
{
    float s = sin(17.0 * v.x + 0.1 * v.y);
    return fract(1.0e4 * s * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float hash3D(vec3 v)
{
    float h = hash(v.xy);
    return hash(vec2(h, v.z));
}

float cumulative(float x, float a)
{
    vec3 c;
    c.x = x * x / (2.0 * a * (1.0 - a));
    c.y = (x - 0.5 * a) / (1.0 - a);
    c.z = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    return x < a ? c.x : (x < 1.0 - a ? c.y : c.z);
}

float threshold(vec3 position)
{
    vec2 dx = dFdx(position.xy);
    vec2 dy = dFdy(position.xy);
    float maxDeriv = max(length(dx), length(dy));

    float l = log2(1.0 / maxDeriv);
    float s0 = exp2(floor(l));
    float s1 = exp2(floor(l) + 1.0);

    float h0 = hash3D(floor(s0 * position));
    float h1 = hash3D(floor(s1 * position));

    float k = fract(l);
    float x = (1.0 - k) * h0 + k * h1;
    float t = cumulative(x, min(k, 1.0 - k));
    return clamp(t, 1.0e-6, 1.0);
}
