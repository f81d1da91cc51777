import type { RenderPipeline, ShaderSource } from '../gpu';
import { commonStructs, tonemapAgx, fogFn } from './chunks';

export const MAX_LIGHTS = 4;

export const foliageUi = {
  title: 'Foliage',
  fields: [
    { key: 'grain', type: 'range', min: 0.25, max: 8, default: 1, hint: "Noise size in pixels; don't go below 0.5 without TAA" },
    { key: 'translucency', type: 'range', min: 0, max: 1, default: 0.4 },
    { key: 'twoSided', type: 'bool', default: true },
  ],
} as const;

// language=WGSL
export const foliageShader = (opts: { fog: boolean }): ShaderSource => ({
  label: `foliage${opts.fog ? '+fog' : ''}`,
  code: /* wgsl */ `
${commonStructs}

struct FoliageUniforms {
  tint: vec4f,
  grain: f32,
  translucency: f32,
  frame: u32,
  _pad: u32,
}

struct DirectionalLight {
  direction: vec3f,
  color: vec3f,
}

@group(0) @binding(1) var<uniform> lights: array<DirectionalLight, ${MAX_LIGHTS}>;
@group(1) @binding(0) var<uniform> u: FoliageUniforms;
@group(1) @binding(1) var albedoTex: texture_2d<f32>;
@group(1) @binding(2) var thicknessTex: texture_2d<f32>;
@group(1) @binding(3) var linearSampler: sampler;

struct VSOut {
  @builtin(position) clipPos: vec4f,
  @location(0) objectPos: vec3f,
  @location(1) viewDepth: f32,
  @location(2) normal: vec3f,
  @location(3) uv: vec2f,
}

fn rand2(v: vec2f) -> f32 {
  return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
}

fn rand3(v: vec3f) -> f32 {
  return rand2(vec2f(rand2(v.xy), v.z));
}

${tonemapAgx}
${opts.fog ? fogFn : ''}

@fragment
fn fs_main(in: VSOut, @builtin(front_facing) front: bool) -> @location(0) vec4f {
  var color = textureSample(albedoTex, linearSampler, in.uv) * u.tint;
  let thickness = textureSample(thicknessTex, linearSampler, in.uv).r;

  // --- hashed alpha test -------------------------------------------------
  let p = in.objectPos;
  let maxDeriv = max(length(dpdx(p)), length(dpdy(p)));
  let pixScale = 1.0 / (u.grain * maxDeriv);
  let scales = exp2(vec2f(floor(log2(pixScale)), ceil(log2(pixScale))));
  let noise = vec2f(rand3(floor(scales.x * p)), rand3(floor(scales.y * p)));
  let f = fract(log2(pixScale));
  let x = (1.0 - f) * noise.x + f * noise.y;

  let a = min(f, 1.0 - f);
  let cases = vec3f(
    x * x / (2.0 * a * (1.0 - a)),
    (x - 0.5 * a) / (1.0 - a),
    1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a))),
  );
  var threshold = select(cases.z, select(cases.y, cases.x, x < a), x < 1.0 - a);
  threshold = clamp(threshold, 1.0e-6, 1.0);

  if (color.a < threshold) { discard; }
  // -----------------------------------------------------------------------

  let n = normalize(select(-in.normal, in.normal, front));
  var lit = color.rgb * 0.05;
  for (var i = 0; i < ${MAX_LIGHTS}; i++) {
    let ndl = dot(n, -lights[i].direction);
    lit += color.rgb * lights[i].color * (max(ndl, 0.0) + u.translucency * (1.0 - thickness) * max(-ndl, 0.0));
  }
  ${opts.fog ? 'lit = applyFog(lit, in.viewDepth);' : ''}
  return vec4f(tonemap(lit), 1.0);
}
`,
});

export function bindFoliage(pipeline: RenderPipeline, grain: number, translucency: number, frame: number): void {
  const f = new Float32Array(8);
  f.set([1, 1, 1, 1, Math.max(grain, 0.25), translucency]);
  new Uint32Array(f.buffer)[6] = frame >>> 0;
  pipeline.writeUniforms(1, 0, f);
}
