// CCProgram dither-hash-fs: the mask of builtin-standard as an option of its own
precision highp float;
#include <builtin/uniforms/cc-global>
#include <legacy/output>
#include <common/color/gamma>

in vec3 v_localPos;
in vec2 v_uv;
in vec4 v_color;

#pragma builtin(local)
layout(set = 2, binding = 12) uniform sampler2D cc_spriteTexture;

#if USE_TEXTURE
  in mediump vec2 v_uv1;
  uniform sampler2D mainTexture;
#endif

uniform Constant {
  vec4 mainColor;
  vec4 hashParams; // x: scale
};

#define INV_2_24 5.9604644775390625e-8

uint mixBits (uint h) {
  h ^= h >> 16;
  h *= 0x7feb352du;
  h ^= h >> 15;
  h *= 0x846ca68bu;
  h ^= h >> 16;
  return h;
}

// a cell's value
float cellHash (ivec3 c) {
  uint h = mixBits(uint(c.x));
  h = mixBits(h ^ (uint(c.y) * 0x9e3779b9u));
  h = mixBits(h ^ (uint(c.z) * 0x85ebca6bu));
  return float(h >> 8) * INV_2_24;
}

float octaveHash (vec3 p, float scale) {
  return cellHash(ivec3(p * scale));
}

// 1.0: stays, 0.0: goes
float hashCoverage (vec3 localPos, float alpha, float scale) {
  float width = max(length(dFdx(localPos)), length(dFdy(localPos)));
  float lod = log2(1.0 / (scale * width));
  float lo = floor(lod);
  float hi = ceil(lod);
  float t = fract(lod);
  float x = mix(octaveHash(localPos, exp2(lo)), octaveHash(localPos, exp2(hi)), t);
  float a = min(t, 1.0 - t);
  vec3 cases = vec3(
    x * x / (2.0 * a * (1.0 - a)),
    (x - 0.5 * a) / (1.0 - a),
    1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))
  );
  float threshold = x < 1.0 - a ? (x < a ? cases.x : cases.y) : cases.z;
  return alpha < clamp(threshold, 1e-6, 1.0) ? 0.0 : 1.0;
}

vec4 frag () {
  vec4 o = mainColor * v_color;
  #if USE_TEXTURE
    vec4 tex = texture(mainTexture, v_uv1);
    tex.rgb = SRGBToLinear(tex.rgb);
    o *= tex;
  #endif
  #if USE_HASHED
    o.a = hashCoverage(v_localPos, o.a, hashParams.x);
    if (o.a < 0.5) discard;
  #endif
  return CCFragOutput(o);
}
