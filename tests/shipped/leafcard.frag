#version 100
// leafcard.frag - canopy cards, WebGL 1 path. Keep in sync with leafcard_es3.frag (or don't, nobody's on ES3 yet).
#extension GL_OES_standard_derivatives : enable

#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif
precision lowp sampler2D;

#define MAX_LAMPS 3
#ifndef HASH_SCALE
#define HASH_SCALE 1.0
#endif

uniform sampler2D uLeafTex;
uniform sampler2D uLeafTranslucency;
uniform vec3 uSunDir;
uniform vec3 uSunColor;
uniform vec3 uAmbient;
uniform vec4 uFog;              // rgb, density
uniform float uCutoff;
uniform vec3 uLampPos[MAX_LAMPS];
uniform vec3 uLampColor[MAX_LAMPS];

varying mediump vec3 vObjPos;   // it's object space: wind is added *after* this one is written
varying vec3 vWorldPos;
varying vec3 vNormal;
varying vec2 vUv;
varying lowp vec4 vTint;

vec3 srgbToLinear(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }

vec3 linearToSrgb(vec3 c)
{
    return max(1.055 * pow(max(c, vec3(0.0)), vec3(0.416666667)) - 0.055, vec3(0.0));
}

#ifdef USE_ALPHAHASH

float rand2(vec2 v)
{
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float rand3(vec3 v) { return rand2(vec2(rand2(v.xy), v.z)); }

float alphaHashThresh(mediump vec3 objPos)
{
    // how far does the surface move from this pixel to its neighbours?
    float stepLen = max(length(dFdx(objPos)), length(dFdy(objPos)));
    float lod = log2(1.0 / (HASH_SCALE * stepLen));

    float s0 = exp2(floor(lod)), s1 = exp2(ceil(lod));
    float h0 = rand3(floor(s0 * objPos));
    float h1 = rand3(floor(s1 * objPos));

    float k = fract(lod);
    float x = mix(h0, h1, k);

    // mixing two uniform values isn't uniform any more, undo that
    float a = min(k, 1.0 - k);
    float tau;
    if (x < a)
        tau = x * x / (2.0 * a * (1.0 - a));
    else if (x < 1.0 - a)
        tau = (x - 0.5 * a) / (1.0 - a);
    else
        tau = 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));

    return clamp(tau, 1.0e-6, 1.0);
}

#endif // USE_ALPHAHASH

vec3 lamps(vec3 n, vec3 albedo)
{
    vec3 sum = vec3(0.0);
    for (int i = 0; i < MAX_LAMPS; i++) {
        vec3 d = uLampPos[i] - vWorldPos;
        float atten = 1.0 / (1.0 + dot(d, d));
        sum += uLampColor[i] * atten * max(dot(n, normalize(d)), 0.0);
    }
    return sum * albedo;
}

void main()
{
    vec4 leaf = texture2D(uLeafTex, vUv) * vTint;

#ifdef USE_ALPHAHASH
    if (leaf.a < alphaHashThresh(vObjPos))
        discard;
#else
    if (leaf.a < uCutoff)
        discard;
#endif

    vec3 albedo = srgbToLinear(leaf.rgb);
    vec3 n = normalize(gl_FrontFacing ? vNormal : -vNormal);
    float wrap = max(dot(n, uSunDir) * 0.5 + 0.5, 0.0);
    float back = texture2D(uLeafTranslucency, vUv).r * max(-dot(n, uSunDir), 0.0);

    vec3 lit = albedo * (uAmbient + uSunColor * (wrap * wrap + back)) + lamps(n, albedo);
    float fog = 1.0 - exp(-uFog.a * gl_FragCoord.z / gl_FragCoord.w);
    gl_FragColor = vec4(linearToSrgb(mix(lit, uFog.rgb, fog)), 1.0);
}
