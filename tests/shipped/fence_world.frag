#version 330

// Chain-link fences, cables, railings: world space variant (static geometry only!)

#pragma optionNV(unroll all)

in vec3 v_worldPos;
in vec3 v_worldNormal;
in vec2 v_uv0;
in vec2 v_lightmapUV;

layout(location = 0) out vec4 rt0;
layout(location = 1) out vec4 rt1;

uniform sampler2D t_base;
uniform sampler2D t_lightmap;
uniform samplerCube t_env;

uniform struct {
    vec3 camera;
    float time;
    uint frame;
} g_view;

uniform float m_metalness;
uniform float m_roughness;
uniform vec4 m_color;

#define HASH_SCALE 1.0
#define PIXEL_FOOTPRINT(q) length(fwidth(q))
#define saturate(x) clamp(x, 0.0, 1.0)

float hash12(vec2 p)
{
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float hash13(vec3 p)
{
    return hash12(vec2(hash12(p.xy), p.z));
}

#if 0
// Doesn't work on the Intel laptops, they don't like the switch
float fenceThreshold(vec3 wpos) { switch (int(wpos.x)) { case 0: return 0.5; default: return 0.0
#endif

float fenceThreshold(vec3 wpos)
{
    float scale = 1.0 / (HASH_SCALE * PIXEL_FOOTPRINT(wpos));

    float lg = log2(scale);
    float s0 = exp2(floor(lg));
    float s1 = exp2(ceil(lg));
    float t  = fract(lg);
    float x  = mix(hash13(floor(s0 * wpos)), hash13(floor(s1 * wpos)), t);

    float a  = min(t, 1.0 - t);
    float tail = 1.0 / (2.0 * a * (1.0 - a));
    float r;
    if (x < a)
        r = x * x * tail;
    else if (x < 1.0 - a)
        r = (x - 0.5 * a) / (1.0 - a);
    else
        r = 1.0 - (1.0 - x) * (1.0 - x) * tail;
    return clamp(r, 1.0e-6, 1.0);
}

vec3 fresnel(vec3 f0, float c)
{
    return f0 + (1.0 - f0) * pow(1.0 - c, 5.0);
}

void main()
{
    vec4 base = texture(t_base, v_uv0) * m_color;
    if (base.a < fenceThreshold(v_worldPos)) { discard; }

    vec3 n = normalize(v_worldNormal);
    vec3 v = normalize(g_view.camera - v_worldPos);
    n = faceforward(n, -v, n);

    vec3 f0 = mix(vec3(0.04), base.rgb, m_metalness);
    vec3 f = fresnel(f0, saturate(dot(n, v)));
    vec3 env = textureLod(t_env, reflect(-v, n), m_roughness * 7.0).rgb;
    vec3 gi = texture(t_lightmap, v_lightmapUV).rgb * 4.0;

    rt0 = vec4(base.rgb * (1.0 - m_metalness) * gi + f * env, 1.0);
    rt1 = vec4(n * 0.5 + 0.5, m_roughness);
}
