// WGSL flavour of the vegetation plugin. See the GLSL one for what's what.
import { ShaderStore } from "../../Engines/shaderStore";
import "../../ShadersWGSL/ShadersInclude/helperFunctions";

const name = "hashedVegetationPixelShader";

/** Tunables that the plugin knows of */
export interface IVegetationOptions {
    hashScale: number;
    useShadow?: boolean;
}

const shader = `
varying vPosition: vec3f;
varying vNormalW: vec3f;
varying vUV: vec2f;

uniform baseColor: vec4f;
uniform hashScale: f32;
uniform lightDirection: vec3f;

var baseSamplerSampler: sampler;
var baseSampler: texture_2d<f32>;

#include<helperFunctions>
#include<fogFragmentDeclaration>

fn hashOf2(v: vec2f) -> f32 {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

fn hashOf3(v: vec3f) -> f32 {
    return hashOf2(vec2f(hashOf2(v.xy), v.z));
}

fn widthOf(p: vec3f) -> f32 {
    return max(length(dpdx(p)), length(dpdy(p)));
}

// true where the pixel's to be thrown away
fn isMasked(alpha: f32) -> bool {
    let p = fragmentInputs.vPosition;
    let lod = log2(1.0 / (uniforms.hashScale * widthOf(p)));
    let f = fract(lod);
    let x = (1.0 - f) * hashOf3(floor(exp2(floor(lod)) * p))
        + f * hashOf3(floor(exp2(ceil(lod)) * p));

    let a = min(f, 1.0 - f);
    let q = 2.0 * a * (1.0 - a);
    var t = 1.0 - (1.0 - x) * (1.0 - x) / q;
    if (x < 1.0 - a) {
        t = (x - 0.5 * a) / (1.0 - a);
        if (x < a) {
            t = x * x / q;
        }
    }
    return alpha < clamp(t, 1.0e-6, 1.0);
}

#define CUSTOM_FRAGMENT_DEFINITIONS

@fragment
fn main(input: FragmentInputs) -> FragmentOutputs {
#define CUSTOM_FRAGMENT_MAIN_BEGIN
    let tex = textureSample(baseSampler, baseSamplerSampler, fragmentInputs.vUV);
    let alpha = tex.a * uniforms.baseColor.a;
    if (isMasked(alpha)) {
        discard;
    }
    let ndl = max(0.0, dot(normalize(fragmentInputs.vNormalW), -uniforms.lightDirection));
    var color = vec4f(tex.rgb * uniforms.baseColor.rgb * (0.3 + 0.7 * ndl), 1.0);
#include<fogFragment>(color, color)
    fragmentOutputs.color = color;
#define CUSTOM_FRAGMENT_MAIN_END
}
`;

ShaderStore.ShadersStoreWGSL[name] = shader;
/** @internal */
export const hashedVegetationPixelShaderWGSL = { name, shader };
