/*
 * Stochastic alpha pass: writes visibility ids.
 */
#version 460
#extension GL_EXT_scalar_block_layout : enable
#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_GOOGLE_include_directive : enable

#define ALPHA_OPAQUE 0
#define ALPHA_MASK   1
#define ALPHA_BLEND  2

#define FRAME_SETTINGS 0
#define MATERIALS      1

struct Material
{
  vec4  pbrBaseColorFactor;
  int   pbrBaseColorTexture;
  int   alphaMode;
  float alphaCutoff;
  float transmissionFactor;
};

struct PushConstant
{
  uint64_t materialAddress;
  int      instanceId;
  int      materialId;
  int      frame;
  float    hashScale;
  uint     flags;
};

layout(buffer_reference, scalar) readonly buffer Materials { Material m[]; };

layout(push_constant, scalar) uniform PushConstant_
{
  PushConstant pc;
};

layout(set = 0, binding = FRAME_SETTINGS, scalar) uniform FrameInfo_
{
  mat4 viewProj;
  mat4 viewProjPrev;
  vec3 cameraPosition;
  vec2 jitter;
} frameInfo;

layout(set = 0, binding = 2) uniform sampler2D texturesMap[];

layout(location = 0) in Interpolants
{
  vec3 objPos;
  vec3 worldPos;
  vec3 normal;
  vec2 uv;
} IN;

layout(location = 0) out uvec2 outId;
layout(location = 1) out vec2 outMotion;

float wangSine(in vec2 v)
{
  return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

float wangSine3(in vec3 v)
{
  return wangSine(vec2(wangSine(v.xy), v.z));
}

//-----------------------------------------------------------------------------
// Threshold that follows each axis of the object on its own
//-----------------------------------------------------------------------------
float anisotropicThreshold(in vec3 objCoord)
{
  vec3 anisoDeriv  = max(abs(dFdx(objCoord)), abs(dFdy(objCoord)));
  vec3 anisoScales = vec3(0.707 / (pc.hashScale * anisoDeriv.x),
                          0.707 / (pc.hashScale * anisoDeriv.y),
                          0.707 / (pc.hashScale * anisoDeriv.z));

  vec3 scaleFlr  = vec3(exp2(floor(log2(anisoScales.x))), exp2(floor(log2(anisoScales.y))), exp2(floor(log2(anisoScales.z))));
  vec3 scaleCeil = vec3(exp2(ceil(log2(anisoScales.x))), exp2(ceil(log2(anisoScales.y))), exp2(ceil(log2(anisoScales.z))));

  vec2 alpha = vec2(wangSine3(floor(scaleFlr * objCoord)), wangSine3(floor(scaleCeil * objCoord)));

  vec3  fractLoc   = vec3(fract(log2(anisoScales.x)), fract(log2(anisoScales.y)), fract(log2(anisoScales.z)));
  vec2  toCorners  = vec2(length(fractLoc), length(vec3(1.0) - fractLoc));
  float lerpFactor = toCorners.x / (toCorners.x + toCorners.y);

  float x     = (1.0 - lerpFactor) * alpha.x + lerpFactor * alpha.y;
  float a     = min(lerpFactor, 1.0 - lerpFactor);
  vec3  cases = vec3(x * x / (2.0 * a * (1.0 - a)), (x - 0.5 * a) / (1.0 - a), 1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))));
  float at    = (x < (1.0 - a)) ? ((x < a) ? cases.x : cases.y) : cases.z;
  return clamp(at, 1.0e-6, 1.0);
}

void main()
{
  Material mat   = Materials(pc.materialAddress).m[pc.materialId];
  float    alpha = mat.pbrBaseColorFactor.a;
  if(mat.pbrBaseColorTexture > -1)
    alpha *= texture(texturesMap[nonuniformEXT(mat.pbrBaseColorTexture)], IN.uv).a;

  switch(mat.alphaMode)
  {
    case ALPHA_MASK:
      if(alpha < mat.alphaCutoff)
        discard;
      break;
    case ALPHA_BLEND:
      if(alpha < anisotropicThreshold(IN.objPos))
        discard;
      break;
    default:
      break;
  }

  vec4 now  = frameInfo.viewProj * vec4(IN.worldPos, 1.0);
  vec4 then = frameInfo.viewProjPrev * vec4(IN.worldPos, 1.0);
  outMotion = now.xy / now.w - then.xy / then.w - frameInfo.jitter;
  outId     = uvec2(uint(pc.instanceId), uint(gl_PrimitiveID));
}
