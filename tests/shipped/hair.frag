#version 330 core

// Hair cards. Kajiya-Kay with two lobes, stochastic transparency instead of sorting 60k cards.

in VS_OUT {
    vec3 objPos;
    vec3 worldPos;
    vec3 tangent;
    vec3 normal;
    vec2 uv;
    vec4 shadowPos;
} fs_in;

out vec4 FragColor;

uniform sampler2D uDiffuse;
uniform sampler2D uAlpha;
uniform sampler2D uShift;
uniform sampler2DShadow uShadowMap;

uniform vec3 uEye;
uniform vec3 uLightDir;
uniform vec3 uLightColor;
uniform vec3 uRootColor;
uniform vec3 uTipColor;
uniform float uNoiseSize;        // noise, in pixels
uniform vec2 uSpecularPower;
uniform int uFrame;              // for uJitter in the resolve; don't feed it to the hash, the cards flicker

float noise(vec2 v)
{
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float noise(vec3 v)
{
    return noise(vec2(noise(v.xy), v.z));
}

float cdf(float x, float a)
{
    float n = 2.0 * a * (1.0 - a);
    return x < a       ? x * x / n
         : x < 1.0 - a ? (x - 0.5 * a) / (1.0 - a)
         :               1.0 - (1.0 - x) * (1.0 - x) / n;
}

// Cards are seen edge-on most of the time, hence a scale of its own for each axis.
float anisoThreshold(vec3 p)
{
    vec3 deriv  = max(abs(dFdx(p)), abs(dFdy(p)));
    vec3 scales = 0.707 / (uNoiseSize * deriv);

    vec3 level = log2(scales);
    vec3 lo = exp2(floor(level));
    vec3 hi = exp2(ceil(level));

    float h0 = noise(floor(lo * p));
    float h1 = noise(floor(hi * p));

    // distance to the two corners of the cube of levels
    vec3 f = fract(level);
    vec2 toCorners = vec2(length(f), length(vec3(1.0) - f));
    float w = toCorners.x / (toCorners.x + toCorners.y);

    float x = h0 * (1.0 - w) + h1 * w;
    return clamp(cdf(x, min(w, 1.0 - w)), 1.0e-6, 1.0);
}

float strandSpecular(vec3 t, vec3 v, vec3 l, float power)
{
    vec3 h = normalize(l + v);
    float th = dot(t, h);
    float s = sqrt(max(1.0 - th * th, 0.0));
    return smoothstep(-1.0, 0.0, th) * pow(s, power);
}

float shadow()
{
    vec3 p = fs_in.shadowPos.xyz / fs_in.shadowPos.w * 0.5 + 0.5;
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            sum += texture(uShadowMap, vec3(p.xy + vec2(x, y) / 2048.0, p.z - 0.001));
    return sum / 9.0;
}

void main()
{
    float alpha = texture(uAlpha, fs_in.uv).r;
    if (alpha < anisoThreshold(fs_in.objPos))
        discard;

    vec3 albedo = texture(uDiffuse, fs_in.uv).rgb * mix(uRootColor, uTipColor, fs_in.uv.y);
    float shift = texture(uShift, fs_in.uv).r - 0.5;

    vec3 n = normalize(fs_in.normal);
    vec3 t = normalize(fs_in.tangent);
    vec3 v = normalize(uEye - fs_in.worldPos);
    vec3 l = -uLightDir;

    float diffuse = clamp(mix(0.25, 1.0, dot(n, l)), 0.0, 1.0);
    float s1 = strandSpecular(normalize(t + (shift - 0.1) * n), v, l, uSpecularPower.x);
    float s2 = strandSpecular(normalize(t + (shift + 0.2) * n), v, l, uSpecularPower.y);

    vec3 c = (albedo * diffuse + 0.3 * vec3(s1) + 0.5 * albedo * s2) * uLightColor * shadow();
    FragColor = vec4(pow(c / (1.0 + c), vec3(1.0 / 2.2)), 1.0);
}
