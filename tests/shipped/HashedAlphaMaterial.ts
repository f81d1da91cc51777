import { Color, DoubleSide, ShaderMaterial, Texture, UniformsLib, UniformsUtils } from 'three';
import { fogPars, fogApply } from '../chunks/fog';
import { LIGHT_COUNT } from '../config';
import type { Inspectable } from '../editor/types';

export interface HashedAlphaOptions {
  map: Texture;
  /** Size of a grain in pixels. `1` is what the paper uses. */
  grain?: number;
  tint?: Color;
}

// The inspector reads these; don't rename the keys.
const meta: Inspectable = {
  grain: { label: 'Grain', widget: 'slider', min: 0.25, max: 4, step: 0.05 },
  tint: { label: 'Tint', widget: 'color' },
};

const vertexShader = /* glsl */ `
  varying vec2 vUv;
  varying vec3 vNormalW;
  varying vec3 vPosition;
  varying float vDepth;

  void main() {
    vUv = uv;
    vPosition = position;
    vNormalW = normalize(mat3(modelMatrix) * normal);
    vec4 mv = modelViewMatrix * vec4(position, 1.0);
    vDepth = -mv.z;
    gl_Position = projectionMatrix * mv;
  }
`;

const fragmentShader = /* glsl */ `
  precision highp float;
  #include <common>
  ${fogPars}

  uniform sampler2D map;
  uniform vec3 tint;
  uniform float grain;
  uniform float opacity;
  uniform vec3 lightDir[${LIGHT_COUNT}];
  uniform vec3 lightColor[${LIGHT_COUNT}];

  varying vec2 vUv;
  varying vec3 vNormalW;
  varying vec3 vPosition;
  varying float vDepth;

  float noise2(vec2 v) {
    return fract(1.0e4 * sin(17.0 * v.x + 0.1 * v.y) * (0.1 + abs(sin(13.0 * v.y + v.x))));
  }

  float noise3(vec3 v) {
    return noise2(vec2(noise2(v.xy), v.z));
  }

  vec3 aces(vec3 v) {
    return clamp((v * (2.51 * v + 0.03)) / (v * (2.43 * v + 0.59) + 0.14), 0.0, 1.0);
  }

  void main() {
    vec4 color = texture2D(map, vUv);
    color.rgb *= tint;
    color.a *= opacity;

    // ---- hashed alpha: what's \`opacity\` in the mean comes out as coverage
    float maxDeriv = max(length(dFdx(vPosition)), length(dFdy(vPosition)));
    float pixScale = 1.0 / (grain * maxDeriv);
    float lo = exp2(floor(log2(pixScale)));
    float hi = exp2(ceil(log2(pixScale)));
    float f = fract(log2(pixScale));
    float x = mix(noise3(floor(lo * vPosition)), noise3(floor(hi * vPosition)), f);

    float a = min(f, 1.0 - f);
    vec3 c = vec3(
      x * x / (2.0 * a * (1.0 - a)),
      (x - 0.5 * a) / (1.0 - a),
      1.0 - ((1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a)))
    );
    float threshold = (f < 1.0 - a) ? ((f < a) ? c.x : c.y) : c.z;
    threshold = clamp(threshold, 1.0e-6, 1.0);

    if (color.a < threshold) discard;

    vec3 n = normalize(gl_FrontFacing ? vNormalW : -vNormalW);
    vec3 sum = vec3(0.08) * color.rgb;
    for (int i = 0; i < ${LIGHT_COUNT}; i++) {
      sum += color.rgb * lightColor[i] * max(dot(n, lightDir[i]), 0.0);
    }
    sum = aces(sum);
    ${fogApply('sum', 'vDepth')}
    gl_FragColor = vec4(sum, 1.0);
  }
`;

export class HashedAlphaMaterial extends ShaderMaterial {
  static readonly inspect = meta;

  constructor({ map, grain = 1, tint = new Color(0xffffff) }: HashedAlphaOptions) {
    super({
      name: 'HashedAlphaMaterial',
      uniforms: UniformsUtils.merge([
        UniformsLib.fog,
        { map: { value: map }, grain: { value: grain }, tint: { value: tint }, opacity: { value: 1 } },
      ]),
      vertexShader,
      fragmentShader,
      side: DoubleSide,
    });
  }

  set grain(v: number) {
    this.uniforms.grain.value = Math.max(v, 0.25);
  }
}
