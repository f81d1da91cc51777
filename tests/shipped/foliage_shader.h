/*******************************************************************************************
*
*   foliage - shader for grass cards, embedded for single-file distribution
*
********************************************************************************************/

#ifndef FOLIAGE_SHADER_H
#define FOLIAGE_SHADER_H

#include "raylib.h"
#include "raymath.h"
#include <stddef.h>

#if defined(PLATFORM_DESKTOP)
    #define GLSL_VERSION            330
#else   // PLATFORM_ANDROID, PLATFORM_WEB
    #define GLSL_VERSION            100
#endif

#define FOLIAGE_MAX_LIGHTS 4

typedef struct FoliageShader {
    Shader shader;
    int locHashScale;
    int locTime;
    int locAmbient;
    int locLights[FOLIAGE_MAX_LIGHTS];
} FoliageShader;

static const char *foliageVs =
    "#version 330\n"
    "in vec3 vertexPosition;\n"
    "in vec2 vertexTexCoord;\n"
    "in vec3 vertexNormal;\n"
    "in vec4 vertexColor;\n"
    "uniform mat4 mvp;\n"
    "uniform mat4 matModel;\n"
    "uniform float time;\n"
    "out vec2 fragTexCoord;\n"
    "out vec4 fragColor;\n"
    "out vec3 fragLocal;\n"
    "out vec3 fragPosition;\n"
    "out vec3 fragNormal;\n"
    "void main()\n"
    "{\n"
    "    vec3 p = vertexPosition;\n"
    "    p.x += sin(time + p.y)*0.05*p.y;\n"
    "    fragLocal = vertexPosition;\n"
    "    fragPosition = vec3(matModel*vec4(p, 1.0));\n"
    "    fragTexCoord = vertexTexCoord;\n"
    "    fragColor = vertexColor;\n"
    "    fragNormal = mat3(matModel)*vertexNormal;\n"
    "    gl_Position = mvp*vec4(p, 1.0);\n"
    "}\n";

static const char *foliageFs =
    "#version 330\n"
    "in vec2 fragTexCoord;\n"
    "in vec4 fragColor;\n"
    "in vec3 fragLocal;\n"
    "in vec3 fragPosition;\n"
    "in vec3 fragNormal;\n"
    "uniform sampler2D texture0;\n"
    "uniform vec4 colDiffuse;\n"
    "uniform vec4 ambient;\n"
    "uniform float hashScale;\n"
    "struct Light {\n"
    "    int enabled;\n"
    "    int type;\n"
    "    vec3 position;\n"
    "    vec3 target;\n"
    "    vec4 color;\n"
    "};\n"
    "uniform Light lights[4];\n"
    "out vec4 finalColor;\n"
    "\n"
    "float Hash2(vec2 p)\n"
    "{\n"
    "    return fract(1.0e4*sin(17.0*p.x + 0.1*p.y)*(0.1 + abs(sin(13.0*p.y + p.x))));\n"
    "}\n"
    "\n"
    "float Hash3(vec3 p)\n"
    "{\n"
    "    return Hash2(vec2(Hash2(p.xy), p.z));\n"
    "}\n"
    "\n"
    "void main()\n"
    "{\n"
    "    vec4 texel = texture(texture0, fragTexCoord)*colDiffuse*fragColor;\n"
    "\n"
    "    // Hashed alpha test\n"
    "    float maxDeriv = max(length(dFdx(fragLocal)), length(dFdy(fragLocal)));\n"
    "    float pixScale = 1.0/(hashScale*maxDeriv);\n"
    "    float s0 = exp2(floor(log2(pixScale)));\n"
    "    float s1 = exp2(ceil(log2(pixScale)));\n"
    "    float h0 = Hash3(floor(s0*fragLocal));\n"
    "    float h1 = Hash3(floor(s1*fragLocal));\n"
    "    float f = fract(log2(pixScale));\n"
    "    float x = mix(h0, h1, f);\n"
    "    float a = min(f, 1.0 - f);\n"
    "    float threshold = 0.0;\n"
    "    if (x < a) threshold = x*x/(2.0*a*(1.0 - a));\n"
    "    else if (x < 1.0 - a) threshold = (x - 0.5*a)/(1.0 - a);\n"
    "    else threshold = 1.0 - (1.0 - x)*(1.0 - x)/(2.0*a*(1.0 - a));\n"
    "    bool keep = texel.a >= clamp(threshold, 1.0e-6, 1.0);\n"
    "    if (!keep) discard;\n"
    "\n"
    "    vec3 normal = normalize(fragNormal);\n"
    "    if (!gl_FrontFacing) normal = -normal;\n"
    "    vec3 lightDot = vec3(0.0);\n"
    "    for (int i = 0; i < 4; i++)\n"
    "    {\n"
    "        if (lights[i].enabled == 1)\n"
    "        {\n"
    "            vec3 light = vec3(0.0);\n"
    "            if (lights[i].type == 0) light = -normalize(lights[i].target - lights[i].position);\n"
    "            if (lights[i].type == 1) light = normalize(lights[i].position - fragPosition);\n"
    "            lightDot += lights[i].color.rgb*max(dot(normal, light), 0.0);\n"
    "        }\n"
    "    }\n"
    "    finalColor = vec4(texel.rgb*(ambient.rgb + lightDot), 1.0);\n"
    "}\n";

static inline FoliageShader LoadFoliageShader(void)
{
    FoliageShader result = { 0 };
    result.shader = LoadShaderFromMemory(foliageVs, foliageFs);
    result.locHashScale = GetShaderLocation(result.shader, "hashScale");
    result.locTime = GetShaderLocation(result.shader, "time");
    result.locAmbient = GetShaderLocation(result.shader, "ambient");
    float scale = 1.0f;
    SetShaderValue(result.shader, result.locHashScale, &scale, SHADER_UNIFORM_FLOAT);
    return result;
}

static inline void UpdateFoliageShader(FoliageShader *fs, float time)
{
    SetShaderValue(fs->shader, fs->locTime, &time, SHADER_UNIFORM_FLOAT);
}

#endif // FOLIAGE_SHADER_H
