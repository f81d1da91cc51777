#version 120
#extension GL_ARB_shader_texture_lod : enable

/* DRAWBUFFERS:027 */

#define HASHED_ALPHA            // Leaves and grass keep their density far away
#define HASH_SCALE 1.0          // Size of the noise in pixels [0.5 1.0 1.5 2.0]
//#define NORMAL_MAPPING
#define WAVING_LEAVES
#define SHADOW_SOFTNESS 1.0     // [0.0 0.5 1.0 2.0]

const int shadowMapResolution = 2048; // [1024 2048 4096]
const float sunPathRotation = -30.0;
const bool shadowHardwareFiltering = true;

uniform sampler2D texture;
uniform sampler2D lightmap;
uniform sampler2D normals;
uniform sampler2DShadow shadow;
uniform vec3 cameraPosition;
uniform vec3 shadowLightPosition;
uniform vec3 fogColor;
uniform int isEyeInWater;
uniform int frameCounter;
uniform int worldTime;
uniform float rainStrength;
uniform float far;

varying vec2 texcoord;
varying vec2 lmcoord;
varying vec4 glcolor;
varying vec3 normal;
varying vec3 worldPos;
varying vec4 shadowPos;
varying float blockId;

float hash12(vec2 p) {
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float hash13(vec3 p) {
    return hash12(vec2(hash12(p.xy), p.z));
}

#ifdef HASHED_ALPHA
float getAlphaThreshold(vec3 pos) {
    float deriv = max(length(dFdx(pos)), length(dFdy(pos)));
    float scale = 1.0 / (HASH_SCALE * deriv);
    float lod = log2(scale);
    float lo = hash13(floor(exp2(floor(lod)) * pos));
    float hi = hash13(exp2(ceil(lod)) * pos);
    float t = fract(lod);
    float x = mix(lo, hi, t);
    float a = min(t, 1.0 - t);
    float inv = 1.0 / (2.0 * a * (1.0 - a));
    float threshold = x < a ? x * x * inv : (x < 1.0 - a ? (x - 0.5 * a) / (1.0 - a) : 1.0 - (1.0 - x) * (1.0 - x) * inv);
    return clamp(threshold, 1.0e-6, 1.0);
}
#endif

float getShadow(float ndotl) {
    if (ndotl <= 0.0) return 0.0;
    vec3 p = shadowPos.xyz / shadowPos.w * 0.5 + 0.5;
    float sum = 0.0;
    for (int x = -1; x <= 1; x++) {
        for (int y = -1; y <= 1; y++) {
            vec2 offset = vec2(x, y) * SHADOW_SOFTNESS / float(shadowMapResolution);
            sum += shadow2D(shadow, vec3(p.xy + offset, p.z - 0.0005)).r;
        }
    }
    return sum / 9.0;
}

vec3 applyFog(vec3 color, float dist) {
    float density = isEyeInWater == 1 ? 0.1 : mix(0.6 / far, 2.0 / far, rainStrength);
    return mix(fogColor, color, exp(-density * dist));
}

void main() {
    vec4 albedo = texture2D(texture, texcoord) * glcolor;

#ifdef HASHED_ALPHA
    if (albedo.a < getAlphaThreshold(worldPos)) discard;
#else
    if (albedo.a < 0.1) discard;
#endif

    albedo.rgb = pow(albedo.rgb, vec3(2.2));
    vec3 n = normal;
#ifdef NORMAL_MAPPING
    n = normalize(n + (texture2D(normals, texcoord).xyz * 2.0 - 1.0) * 0.5);
#endif
    vec3 l = normalize(shadowLightPosition);
    float ndotl = blockId > 9999.5 ? 0.7 : max(dot(n, l), 0.0);
    vec3 light = texture2D(lightmap, lmcoord).rgb * 0.4 + vec3(1.0, 0.9, 0.8) * ndotl * getShadow(ndotl);
    vec3 color = applyFog(albedo.rgb * light, length(worldPos - cameraPosition));

    gl_FragData[0] = vec4(pow(color, vec3(1.0 / 2.2)), 1.0);
    gl_FragData[1] = vec4(n * 0.5 + 0.5, 1.0);
    gl_FragData[2] = vec4(lmcoord, 0.0, 1.0);
}
