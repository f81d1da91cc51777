// GLES 3 build of the alpha hash. Keep in step with the desktop shader.
float hash(const vec2 v)
{
    return fract(1.0e4
        * sin(17.0 * v.x + 0.1 * v.y)
        * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float hash3D(const vec3 v)
{
    return hash(vec2(hash(v.xy), v.z));
}

float cdfLow(float x, float a)  { return x * x / (2.0 * a * (1.0 - a)); }
float cdfMid(float x, float a)  { return x / (1.0 - a); }
float cdfHigh(float x, float a) { return 1.0 - cdfLow(1.0 - x, a); }

float threshold(vec3 P, float hash_scale)
{
    float m = max(length(dFdx(P)), length(dFdy(P)));
    float pixScale = 1.0 / (hash_scale * m);

    float lg = log2(pixScale);
    float f = fract(lg);

    float below = hash3D(floor(P * exp2(floor(lg))));
    float above = hash3D(floor(P * exp2(ceil(lg))));
    float x = f * above + (1.0 - f) * below;

    float a = min(f, 1.0 - f);
    float t;
    if (x < a)
        t = cdfLow(x, a);
    else if (x < 1.0 - a)
        t = cdfMid(x, a);
    else
        t = cdfHigh(x, a);

    return clamp(t, 1.0e-6, 1.0);
}
