import { MaterialPluginBase } from "core/Materials/materialPluginBase";
import { MaterialDefines } from "core/Materials/materialDefines";
import type { UniformBuffer } from "core/Materials/uniformBuffer";
import type { Material } from "core/Materials/material";
import type { Scene } from "core/scene";
import type { SubMesh } from "core/Meshes/subMesh";
import type { AbstractEngine } from "core/Engines/abstractEngine";
import { Nullable } from "core/types";

/** @internal */
export class MaterialHashedAlphaDefines extends MaterialDefines {
    /** is the stochastic cut-out on */
    public HASHEDALPHA = false;
    /** follow the skinned mesh */
    public HASHEDALPHA_SKINNED = false;
}

const vertexDefinitions = `
#ifdef HASHEDALPHA
varying vec3 vHashPosition;
#endif
`;

const vertexUpdate = `
#ifdef HASHEDALPHA
#ifdef HASHEDALPHA_SKINNED
vHashPosition = (influence * vec4(positionUpdated, 1.0)).xyz;
#else
vHashPosition = positionUpdated;
#endif
#endif
`;

const fragmentDefinitions = `
#ifdef HASHEDALPHA
varying vec3 vHashPosition;

float hash2D(vec2 p) {
    return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x))));
}

float hash3D(vec3 p) {
    return hash2D(vec2(hash2D(p.xy), p.z));
}

float hashedCdf(float x, float lerpFactor) {
    float a = max(lerpFactor, 1.0 - lerpFactor);
    float denom = 2.0 * a * (1.0 - a);
    if (x < a) {
        return x * x / denom;
    }
    if (x < 1.0 - a) {
        return (x - 0.5 * a) / (1.0 - a);
    }
    return 1.0 - (1.0 - x) * (1.0 - x) / denom;
}

float hashedAlphaThreshold(vec3 position) {
    vec3 dx = dFdx(position);
    vec3 dy = dFdy(position);
    float maxDeriv = max(length(dx), length(dy));
    float pixScale = 1.0 / (hashedAlphaScale * maxDeriv);
    float logScale = log2(pixScale);
    float s0 = exp2(floor(logScale));
    float s1 = exp2(ceil(logScale));
    float t0 = hash3D(floor(s0 * position));
    float t1 = hash3D(floor(s1 * position));
    float f = fract(logScale);
    return clamp(hashedCdf(mix(t0, t1, f), f), 1.0e-6, 1.0);
}
#endif
`;

const fragmentUpdateAlpha = `
#ifdef HASHEDALPHA
if (alpha < hashedAlphaThreshold(vHashPosition)) {
    discard;
}
alpha = 1.0;
#endif
`;

/**
 * Plugin that replaces alpha blending by hashed alpha testing
 */
export class HashedAlphaPlugin extends MaterialPluginBase {
    private _isEnabled = true;
    /** size of the noise in pixels */
    public noiseScale = 1.0;

    constructor(material: Material) {
        super(material, "HashedAlpha", 210, new MaterialHashedAlphaDefines());
        this._enable(this._isEnabled);
    }

    public override prepareDefines(defines: MaterialHashedAlphaDefines, _scene: Scene, mesh: any): void {
        defines.HASHEDALPHA = this._isEnabled;
        defines.HASHEDALPHA_SKINNED = mesh.useBones && mesh.computeBonesUsingShaders;
    }

    public override getUniforms() {
        return {
            ubo: [{ name: "hashedAlphaScale", size: 1, type: "float" }],
            fragment: `#ifdef HASHEDALPHA
                uniform float hashedAlphaScale;
            #endif`,
        };
    }

    public override bindForSubMesh(ubo: UniformBuffer, _scene: Scene, _engine: AbstractEngine, _subMesh: SubMesh): void {
        if (this._isEnabled) {
            ubo.updateFloat("hashedAlphaScale", this.noiseScale);
        }
    }

    public override getClassName(): string {
        return "HashedAlphaPlugin";
    }

    public override getCustomCode(shaderType: string): Nullable<{ [pointName: string]: string }> {
        if (shaderType === "vertex") {
            return {
                CUSTOM_VERTEX_DEFINITIONS: vertexDefinitions,
                CUSTOM_VERTEX_UPDATE_POSITION: vertexUpdate,
            };
        }
        return {
            CUSTOM_FRAGMENT_DEFINITIONS: fragmentDefinitions,
            CUSTOM_FRAGMENT_UPDATE_ALPHA: fragmentUpdateAlpha,
        };
    }
}
