#version 100
#extension GL_OES_standard_derivatives : enable
// Stippled transparency for the UI models. Returns coverage, so that the same chunk can go into a blend as well.

#ifdef GL_ES
precision highp float;
#endif

uniform sampler2D CC_Texture0;
uniform sampler2D u_ramp;
uniform vec4 u_diffuse;
uniform vec3 u_lightDirView;
uniform float u_fade;
uniform float u_time;

#if defined(USE_VERTEX_COLOR)
varying vec4 v_color;
#endif
varying vec2 v_texCoord;
varying vec3 v_normal;
varying vec3 v_modelPos;

const float SCALE = 1.0;
const float EPS = 1.0e-6;

float n2(vec2 p) { return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x)))); }
float n3(vec3 p) { return n2(vec2(n2(p.xy), p.z)); }

vec3 pulse(vec3 c) { return c * (0.9 + 0.1 * sin(u_time * 3.0)); }

float hashedOpacity(float alpha, vec3 P)
{
    vec3 dx = dFdx(P);
    vec3 dy = dFdy(P);
    float size = SCALE * max(length(dx), length(dy));

    float level = -log2(size);
    float whole = floor(level);
    float part = level - whole;

    vec3 c0 = floor(exp2(whole) * P);
    vec3 c1 = floor(exp2(whole + 1.0) * P);
    float x = n3(c0) + part * (n3(c1) - n3(c0));

    // a <= 1/2 always
    float a = min(part, 1.0 - part);
    float tau = x < a ? x * x : (x < 1.0 - a ? 2.0 * a * x - a * a : 2.0 * a * (1.0 - a) - (1.0 - x) * (1.0 - x));
    tau = a > 0.0 ? tau / (2.0 * a * (1.0 - a)) : x;

    return step(clamp(tau, EPS, 1.0), alpha);
}

vec3 toon(float ndl)
{
    return texture2D(u_ramp, vec2(ndl * 0.5 + 0.5, 0.5)).rgb;
}

void main()
{
    vec4 c = texture2D(CC_Texture0, v_texCoord) * u_diffuse;
#if defined(USE_VERTEX_COLOR)
    c *= v_color;
#endif
    c.a *= u_fade;

#if defined(STIPPLE)
    c.a = hashedOpacity(c.a, v_modelPos);
    if (c.a < 0.5)
        discard;
#endif

    vec3 n = normalize(v_normal);
    c.rgb = pulse(c.rgb * toon(dot(n, u_lightDirView)));

    // premultiplied, as cocos wants it
    gl_FragColor = vec4(c.rgb * c.a, c.a);
}
