// "Leaf on a sphere" - hashed transparency on a ray-traced ball
// Mouse: turn. iChannel0: anything with holes in it (I use the "Organic 2" one; 512'd be enough)

#define PI 3.14159265359
#define HASH_SCALE 1.0
#define AA 1

mat2 rot(float a) { float c = cos(a), s = sin(a); return mat2(c, -s, s, c); }

float hash(vec2 p)
{
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float hash(vec3 p)
{
    return hash(vec2(hash(p.xy), p.z));
}

// q: on the ball, turned with it
float hashedAlpha(vec3 q)
{
    float m = max(length(dFdx(q)), length(dFdy(q)));
    float s = log2(1.0 / (HASH_SCALE * m));
    float lo = exp2(floor(s)), hi = exp2(ceil(s)), f = fract(s);

    float x = mix(hash(floor(lo * q)), hash(floor(hi * q)), f);

    float a = min(f, 1.0 - f), b = 1.0 - a, y = 1.0 - x;
    float t = x < b ? (x < a ? .5 * x * x / (a * b) : (x - .5 * a) / b)
                    : 1. - .5 * y * y / (a * b);
    return clamp(t, 1e-6, 1.);
}

float sphere(vec3 ro, vec3 rd, float r)
{
    float b = dot(ro, rd);
    float h = b * b - dot(ro, ro) + r * r;
    return h < 0. ? -1. : -b - sqrt(h);
}

vec3 sky(vec3 rd)
{
    return mix(vec3(.85, .9, 1.), vec3(.2, .4, .8), clamp(rd.y * .5 + .5, 0., 1.));
}

float coverage(vec3 q)
{
    vec2 uv = vec2(atan(q.z, q.x) / (2. * PI), acos(clamp(q.y, -1., 1.)) / PI);
    return smoothstep(.2, .8, textureLod(iChannel0, uv * 4., 0.).r);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 uv = (2. * fragCoord - iResolution.xy) / iResolution.y;
    vec3 ro = vec3(0, 0, 3);
    vec3 rd = normalize(vec3(uv, -2.));
    float turn = iMouse.z > 0. ? iMouse.x * .01 : iTime * .2;

    vec3 col = sky(rd);
    float t = sphere(ro, rd, 1.);
    vec3 p = ro + max(t, 0.) * rd;
    vec3 q = p;
    q.xz *= rot(turn);

    float threshold = hashedAlpha(q);
    if (t > 0. && coverage(q) >= threshold)
    {
        float l = max(dot(normalize(p), normalize(vec3(1, 2, 1))), 0.);
        col = vec3(.2, .5, .1) * (.2 + l);
    }
    fragColor = vec4(pow(col, vec3(.4545)), 1);
}
