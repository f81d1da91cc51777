// Do not edit by hand: the build makes this file out of hashedFoliage.fragment
import { ShaderStore } from "../Engines/shaderStore";
import "./ShadersInclude/helperFunctions";
import "./ShadersInclude/lightFragmentDeclaration";
import "./ShadersInclude/fogFragmentDeclaration";

const name = "hashedFoliagePixelShader";
const shader = `#if defined(BUMP) || !defined(NORMAL)
#extension GL_OES_standard_derivatives : enable
#endif
precision highp float;

uniform vec4 vEyePosition;
uniform vec4 vDiffuseColor;
uniform float visibility;
uniform float foliageHashScale;

varying vec3 vPositionW;
varying vec3 vPositionO;
#ifdef NORMAL
varying vec3 vNormalW;
#endif
#ifdef DIFFUSE
varying vec2 vDiffuseUV;
uniform sampler2D diffuseSampler;
uniform vec2 vDiffuseInfos;
#endif

#include<helperFunctions>
#include<__decl__lightFragment>[0..maxSimultaneousLights]
#include<fogFragmentDeclaration>

float hash21(vec2 v)
{
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}
float hash31(vec3 v)
{
    return hash21(vec2(hash21(v.xy), v.z));
}
float cdfOfBlend(float x, float a)
{
    float d = 2.0 * a * (1.0 - a);
    if (x < a) {
        return x * x / d;
    } else if (x < 1.0 - a) {
        return (x - 0.5 * a) / (1.0 - a);
    }
    return 1.0 - (1.0 - x) * (1.0 - x) / d;
}

#define CUSTOM_FRAGMENT_DEFINITIONS

void main(void)
{
#define CUSTOM_FRAGMENT_MAIN_BEGIN
#include<clipPlaneFragment>
    vec3 viewDirectionW = normalize(vEyePosition.xyz - vPositionW);
    vec4 baseColor = vec4(1., 1., 1., 1.);
    vec3 diffuseColor = vDiffuseColor.rgb;
    float alpha = vDiffuseColor.a;

#ifdef NORMAL
    vec3 normalW = normalize(vNormalW);
#else
    vec3 normalW = vec3(1.0, 1.0, 1.0);
#endif

#ifdef DIFFUSE
    baseColor = texture2D(diffuseSampler, vDiffuseUV);
    alpha *= baseColor.a;
    baseColor.rgb *= vDiffuseInfos.y;
#endif

    // hashed test: the octaves follow the pixel's size on the mesh
    float derivative = max(length(dFdx(vPositionO)), length(dFdy(vPositionO)));
    float scale = 1.0 / (foliageHashScale * derivative);
    float lower = exp2(floor(log2(scale)));
    float upper = exp2(ceil(log2(scale)));
    float h0 = hash31(floor(lower * vPositionO));
    float h1 = hash31(floor(upper * vPositionO));
    float blend = fract(log2(scale));
    float blended = (1.0 - blend) * h0 + blend * h1;
    float threshold = clamp(cdfOfBlend(blended, min(blend, 1.0 - blend)), 1.0e-6, 1.0);
    if (alpha - threshold < 0.0) discard;

    vec3 diffuseBase = vec3(0., 0., 0.);
    float shadow = 1.;
#include<lightFragment>[0..maxSimultaneousLights]
    vec4 color = vec4(clamp(diffuseBase * diffuseColor, 0.0, 1.0) * baseColor.rgb, 1.0);
#include<fogFragment>
    color.a *= visibility;
    gl_FragColor = color;
#define CUSTOM_FRAGMENT_MAIN_END
}
`;
// Sideeffect
ShaderStore.ShadersStore[name] = shader;
/** @internal */
export const hashedFoliagePixelShader = { name, shader };
