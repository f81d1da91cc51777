import {
  Cesium3DTileset,
  CustomShader,
  LightingModel,
  UniformType,
  VaryingType,
} from "@cesium/engine";

/**
 * Custom shader for photogrammetry vegetation tiles whose textures have a
 * filtered alpha channel. Fragments are dropped stochastically in model space.
 *
 * @param {object} [options]
 * @param {number} [options.noiseSize=1.0] Size of the noise in pixels.
 * @returns {CustomShader}
 */
function createVegetationShader(options) {
  const noiseSize = options?.noiseSize ?? 1.0;

  return new CustomShader({
    lightingModel: LightingModel.PBR,
    uniforms: {
      u_noiseSize: {
        type: UniformType.FLOAT,
        value: noiseSize,
      },
      u_tint: {
        type: UniformType.VEC3,
        value: new Cartesian3(1.0, 1.0, 1.0),
      },
    },
    varyings: {
      v_modelPosition: VaryingType.VEC3,
    },
    vertexShaderText: `
      void vertexMain(VertexInput vsInput, inout czm_modelVertexOutput vsOutput) {
        v_modelPosition = vsInput.attributes.positionMC;
      }
    `,
    fragmentShaderText: `
      float vegetationHash(vec2 p) {
        return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
      }

      float vegetationHash(vec3 p) {
        return vegetationHash(vec2(vegetationHash(p.xy), p.z));
      }

      float vegetationThreshold(vec3 positionMC) {
        vec3 dx = dFdx(positionMC);
        vec3 dy = dFdy(positionMC);
        float pixelScale = 1.0 / (u_noiseSize * max(length(dx), length(dy)));
        float level = log2(pixelScale);
        float coarse = vegetationHash(floor(exp2(floor(level)) * positionMC));
        float fine = vegetationHash(floor(exp2(ceil(level)) * positionMC));
        // Blend between the two octaves.
        float threshold = mix(coarse, fine, fract(level));
        return clamp(threshold, 1.0e-6, 1.0);
      }

      void fragmentMain(FragmentInput fsInput, inout czm_modelMaterial material) {
        float threshold = vegetationThreshold(v_modelPosition);
        if (material.alpha < threshold) {
          discard;
        }
        material.alpha = 1.0;
        material.diffuse *= u_tint;
        material.roughness = max(material.roughness, 0.6);
        material.emissive += 0.02 * czm_lightColor * max(0.0, dot(-fsInput.attributes.normalEC, czm_lightDirectionEC));
      }
    `,
  });
}

/**
 * @param {string} url
 * @returns {Promise<Cesium3DTileset>}
 */
export async function loadVegetation(url) {
  const tileset = await Cesium3DTileset.fromUrl(url, {
    maximumScreenSpaceError: 8,
    backFaceCulling: false,
  });
  tileset.customShader = createVegetationShader();
  return tileset;
}

export default createVegetationShader;
