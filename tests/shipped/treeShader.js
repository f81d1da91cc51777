import { CustomShader, UniformType, VaryingType, LightingModel, Cesium3DTileset } from "cesium";

export async function addTrees(viewer, url) {
  const customShader = new CustomShader({
    lightingModel: LightingModel.PBR,
    uniforms: {
      u_hashScale: { type: UniformType.FLOAT, value: 1.0 },
      u_tint: { type: UniformType.VEC3, value: [1, 1, 1] },
    },
    varyings: {
      v_treePos: VaryingType.VEC3,
    },
    vertexShaderText: /* glsl */ `
      void vertexMain(VertexInput vsInput, inout czm_modelVertexOutput vsOutput)
      {
        v_treePos = vsInput.attributes.positionMC;
      }
    `,
    fragmentShaderText: /* glsl */ `
      float hash2(vec2 p)
      {
        return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
      }
      float hash3(vec3 p)
      {
        return hash2(vec2(hash2(p.xy), p.z));
      }
      float cdf(float x, float a)
      {
        float d = 2.0 * a * (1.0 - a);
        float lo = x * x / d;
        float mid = (x - 0.5 * a) / (1.0 - a);
        float hi = 1.0 - (1.0 - x) * (1.0 - x) / d;
        return (x < 1.0 - a) ? ((x < a) ? lo : mid) : hi;
      }
      void fragmentMain(FragmentInput fsInput, inout czm_modelMaterial material)
      {
        vec3 p = fsInput.attributes.positionMC;
        float md = max(length(dFdx(p)), length(dFdy(p)));
        float s = 1.0 / (u_hashScale * md);
        float e = floor(log2(s));
        float f = log2(s) - e;
        float h0 = hash3(floor(exp2(e) * p));
        float h1 = hash3(floor(exp2(ceil(log2(s))) * p));
        float x = (1.0 - f) * h0 + f * h1;
        float t = clamp(cdf(x, min(f, 1.0 - f)), 1.0e-6, 1.0);
        if (material.alpha < t)
        {
          discard;
        }
        material.alpha = 1.0;
        material.diffuse *= u_tint;
      }
    `,
  });

  const tileset = await Cesium3DTileset.fromUrl(url, { customShader });
  viewer.scene.primitives.add(tileset);
  return tileset;
}
